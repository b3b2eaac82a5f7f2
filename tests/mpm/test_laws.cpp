// Laws of grains: derivatives against differences, symmetries, values by hand, and what plastic flow keeps.
// Bands of 1e-12 and less are rounding of numbers of order 1 to 100, with about ten times the errors seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/errors.hpp"
#include "mpm/laws/elastic_constants.hpp"
#include "mpm/laws/grain_law.hpp"
#include "mpm/laws/return_to_yield.hpp"

namespace softgrain::mpm {
namespace {

constexpr double E = 1.7, nu = 0.3, yield_stress = 0.1;
constexpr double mu = E / (2.0 * (1.0 + nu)), kappa = E / (3.0 * (1.0 - 2.0 * nu)),
                 lambda = kappa - 2.0 * mu / 3.0;

std::unique_ptr<GrainLaw> law_of(LawKind kind, std::optional<double> yield = {}) {
    Material material;
    material.youngs_modulus = E;
    material.poisson_ratio = nu;
    material.yield_stress = yield;
    return make_law(kind, material);
}

Mat2 rotation(double angle) {
    Mat2 Q;
    Q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return Q;
}
Mat2 stretches(double x, double y) {
    return Vec2(x, y).asDiagonal();
}
Mat2 tensor(const Vec4& v) {
    Mat2 T;
    T << v[0], v[1], v[2], v[3];
    return T;
}
Vec4 vector(const Mat2& T) {
    return {T(0, 0), T(0, 1), T(1, 0), T(1, 1)};
}

/// Random F = R(a) diag(l1, l2) R(b): any rotation, any shear.
class Deformations {
  public:
    Deformations(double least, double most) : stretch_(least, most) {}
    Mat2 operator()() {
        const double x = stretch_(random_), y = stretch_(random_);
        return rotation(angle_(random_)) * stretches(x, y) * rotation(angle_(random_));
    }
    double angle() { return angle_(random_); }

  private:
    std::mt19937_64 random_{11};
    std::uniform_real_distribution<double> stretch_, angle_{-3.1, 3.1};
};
constexpr double least_stretch = 0.6, largest_stretch = 1.6;

/// The part of the law without U(J).
Response part_of(const GrainLaw& law, const Mat2& F, const PlasticState& state = {}) {
    Response out;
    law.respond({&F, 1}, {&state, 1}, true, {&out, 1});
    return out;
}
PlasticState flowed(const GrainLaw& law, const Mat2& F, PlasticState state = {}) {
    law.flow({&F, 1}, {&state, 1});
    return state;
}
bool flows(const GrainLaw& law, const Mat2& F, const PlasticState& state) {
    return flowed(law, F, state).equivalent > state.equivalent;
}
/// With U(J) of a law that splits.
Response whole_of(const GrainLaw& law, const Mat2& F, const PlasticState& state = {}) {
    Response out = part_of(law, F, state);
    if (!law.splits()) return out;
    const Volumetric U = law.volumetric(F.determinant());
    const Vec4 C(F(1, 1), -F(1, 0), -F(0, 1), F(0, 0));
    Mat4 turn;
    turn << 0, 0, 0, 1, 0, 0, -1, 0, 0, -1, 0, 0, 1, 0, 0, 0;
    out.energy += U.energy;
    out.stress += U.slope * C;
    out.tangent += U.curvature * C * C.transpose() + U.slope * turn;
    return out;
}
Mat2 kirchhoff(const Response& response, const Mat2& F) {
    return tensor(response.stress) * F.transpose();
}
/// Norm of the deviator of a Kirchhoff stress whose trace, with its zz, is zero.
double norm_of(const Mat2& deviator) {
    return std::hypot(deviator.norm(), deviator.trace());
}

constexpr double step = 3e-4;
Mat2 moved(const Mat2& F, int a, double by) {
    Mat2 G = F;
    G(a / 2, a % 2) += by;
    return G;
}
/// Derivative by component a of F, of fourth order in the step.
template <class Function>
auto slope(const Function& f, const Mat2& F, int a) {
    const auto near = decltype(f(F))(f(moved(F, a, step)) - f(moved(F, a, -step)));
    const auto far = decltype(f(F))(f(moved(F, a, 2.0 * step)) - f(moved(F, a, -2.0 * step)));
    return decltype(f(F))((8.0 * near - far) / (12.0 * step));
}
/// Relative errors of stress and tangent against differences of energy and stress.
struct Errors {
    double stress = 0.0, tangent = 0.0, asymmetry = 0.0;
};
Errors errors_at(const GrainLaw& law, const Mat2& F, const PlasticState& state) {
    const Response here = whole_of(law, F, state);
    Vec4 P;
    Mat4 A;
    for (int a = 0; a < 4; ++a) {
        P[a] = slope([&](const Mat2& G) { return whole_of(law, G, state).energy; }, F, a);
        A.col(a) = slope([&](const Mat2& G) { return whole_of(law, G, state).stress; }, F, a);
    }
    const double size = here.tangent.norm();
    return {(P - here.stress).norm() / here.stress.norm(), (A - here.tangent).norm() / size,
            (here.tangent - here.tangent.transpose()).norm() / size};
}
/// Whether all of the differences are taken on one side of the yield surface.
bool clear_of_yield(const GrainLaw& law, const Mat2& F, const PlasticState& state) {
    const bool here = flows(law, F, state);
    for (int a = 0; a < 4; ++a)
        for (double by : {-2.0 * step, 2.0 * step})
            if (flows(law, moved(F, a, by), state) != here) return false;
    return true;
}
void expect_derivatives(const Errors& errors) {
    // Differences: step^4 times fifth derivatives of up to 10^4, and rounding of energies over the step.
    EXPECT_LT(errors.stress, 1e-9);
    EXPECT_LT(errors.tangent, 1e-9);
    EXPECT_LT(errors.asymmetry, 1e-14);
}

struct LawCase {
    const char* name;
    LawKind kind;
    std::optional<double> yield = {};
};
void PrintTo(const LawCase& c, std::ostream* out) {
    *out << c.name;
}
class EveryLaw : public testing::TestWithParam<LawCase> {
  protected:
    std::unique_ptr<GrainLaw> law_ = law_of(GetParam().kind, GetParam().yield);
    bool objective() const { return GetParam().kind != LawKind::linear; }
};
INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw,
                         testing::Values(LawCase{"neo_hookean", LawKind::neo_hookean},
                                         LawCase{"saint_venant_kirchhoff", LawKind::saint_venant_kirchhoff},
                                         LawCase{"linear", LawKind::linear},
                                         LawCase{"von_mises", LawKind::neo_hookean, yield_stress}),
                         [](const auto& given) { return std::string(given.param.name); });

TEST_P(EveryLaw, StressAndTangentAreDerivativesOfTheEnergy) {
    Deformations any(least_stretch, largest_stretch), moderate(0.95, 1.05);
    int elastic = 0, plastic = 0;
    for (int k = 0; k < 300; ++k) {
        const Mat2 F = k % 2 ? any() : moderate();
        const PlasticState state = k % 3 ? flowed(*law_, any()) : PlasticState{};
        if (!clear_of_yield(*law_, F, state)) continue;
        expect_derivatives(errors_at(*law_, F, state));
        (flows(*law_, F, state) ? plastic : elastic) += 1;
    }
    EXPECT_GT(law_->remembers() ? std::min(elastic, plastic) : elastic, 20);
}

TEST_P(EveryLaw, PartsOfALawThatSplits) {
    if (!law_->splits()) {
        EXPECT_THROW(law_->volumetric(1.0), std::logic_error);
        return;
    }
    // kappa/2 (J - 1)^2 at J = 2, and at rest.
    EXPECT_DOUBLE_EQ(law_->volumetric(2.0).energy, 0.5 * kappa);
    EXPECT_DOUBLE_EQ(law_->volumetric(2.0).slope, kappa);
    EXPECT_DOUBLE_EQ(law_->volumetric(2.0).curvature, kappa);
    EXPECT_EQ(law_->volumetric(1.0).energy, 0.0);
    EXPECT_EQ(law_->volumetric(1.0).slope, 0.0);
}

TEST_P(EveryLaw, IsAtRestAtTheIdentity) {
    const Response r = whole_of(*law_, Mat2::Identity());
    EXPECT_NEAR(r.energy, 0.0, 1e-15);
    EXPECT_NEAR(r.stress.norm(), 0.0, 1e-15);
}

TEST_P(EveryLaw, IsHookesLawAtSmallStrain) {
    Mat4 hooke;
    hooke << lambda + 2 * mu, 0, 0, lambda, 0, mu, mu, 0, 0, mu, mu, 0, lambda, 0, 0, lambda + 2 * mu;
    EXPECT_LT((whole_of(*law_, Mat2::Identity()).tangent - hooke).norm(), 1e-14 * E);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> part(-1e-5, 1e-5);
    for (int k = 0; k < 20; ++k) {
        const Vec4 gradient(part(random), part(random), part(random), part(random));
        const Response r = whole_of(*law_, Mat2::Identity() + tensor(gradient));
        // The next order: a few times the gradient.
        EXPECT_LT((r.stress - hooke * gradient).norm(), 1e-4 * E * gradient.norm());
        // The same, and rounding of energies of order E.
        EXPECT_NEAR(r.energy, 0.5 * gradient.dot(hooke * gradient),
                    1e-4 * E * gradient.squaredNorm() + 1e-15);
    }
}

TEST_P(EveryLaw, AnswersTheSameForAnyNumberOfPointsWithOrWithoutTangent) {
    Deformations any(least_stretch, largest_stretch);
    std::vector<Mat2> F;
    for (int k = 0; k < 7; ++k) F.push_back(any());
    const std::vector<PlasticState> state(law_->remembers() ? F.size() : 0);
    std::vector<Response> with(F.size()), without(F.size());
    for (Response& r : without) r.tangent.setConstant(7.0);
    law_->respond(F, state, true, with);
    law_->respond(F, state, false, without);
    for (std::size_t i = 0; i < F.size(); ++i) {
        const Response alone = part_of(*law_, F[i]);
        EXPECT_EQ(with[i].energy, alone.energy);
        EXPECT_EQ(with[i].stress, alone.stress);
        EXPECT_EQ(with[i].tangent, alone.tangent);
        EXPECT_EQ(without[i].energy, alone.energy);
        EXPECT_EQ(without[i].stress, alone.stress);
        EXPECT_EQ(without[i].tangent, Mat4::Constant(7.0));  // not touched
    }
}

TEST_P(EveryLaw, TurningTheSpaceTurnsTheStressUnlessTheLawIsLinear) {
    Deformations any(least_stretch, largest_stretch);
    for (int k = 0; k < 100; ++k) {
        const Mat2 F = any(), Q = rotation(any.angle());
        const PlasticState state = flowed(*law_, any());
        const Response here = part_of(*law_, F, state), there = part_of(*law_, Q * F, state);
        if (!objective()) {
            EXPECT_GT(std::abs(there.energy - here.energy), 1e-4 * here.energy);  // by chance once in 10^4
            continue;
        }
        EXPECT_NEAR(there.energy, here.energy, 1e-13 * E);
        EXPECT_LT((tensor(there.stress) - Q * tensor(here.stress)).norm(), 1e-12 * E);
    }
}

TEST_P(EveryLaw, IsIsotropic) {
    Deformations any(least_stretch, largest_stretch);
    for (int k = 0; k < 100; ++k) {
        const Mat2 F = any(), Q = rotation(any.angle());
        if (!objective()) {
            // Of small strain only: both sides are turned.
            EXPECT_NEAR(part_of(*law_, Q * F * Q.transpose()).energy, part_of(*law_, F).energy, 1e-13 * E);
            continue;
        }
        // What has flowed turns with the material: the same history, turned.
        const Mat2 before = any();
        const PlasticState state = flowed(*law_, before), turned = flowed(*law_, before * Q);
        const Response here = part_of(*law_, F, state), there = part_of(*law_, F * Q, turned);
        EXPECT_NEAR(there.energy, here.energy, 1e-13 * E);
        EXPECT_LT((tensor(there.stress) - tensor(here.stress) * Q).norm(), 1e-12 * E);
    }
}

TEST_P(EveryLaw, EnergyOfAStepIsWhatItStoresAndDissipates) {
    Deformations any(least_stretch, largest_stretch);
    for (int k = 0; k < 50; ++k) {
        const Mat2 F = any();
        const PlasticState before = flowed(*law_, any()), after = flowed(*law_, F, before);
        EXPECT_NEAR(law_->stored(F, after) + after.dissipated - before.dissipated,
                    part_of(*law_, F, before).energy, 1e-14 * E);
    }
}

TEST(NeoHookean, UniaxialStretchByHand) {
    // l = 8: J^(1/3) = 2 and I1 = 66. W = mu/2 (66/4 - 3), P_xx = 2/3 mu l^(-5/3) (l^2 - 1),
    // P_yy = -mu/3 l^(-2/3) (l^2 - 1).
    const Response r = part_of(*law_of(LawKind::neo_hookean), stretches(8.0, 1.0));
    EXPECT_NEAR(r.energy, 6.75 * mu, 1e-14 * r.energy);
    EXPECT_NEAR(r.stress[0], 1.3125 * mu, 1e-14 * mu);
    EXPECT_NEAR(r.stress[3], -5.25 * mu, 1e-14 * mu);
    EXPECT_EQ(r.stress[1], 0.0);
    EXPECT_EQ(r.stress[2], 0.0);
}

TEST(NeoHookean, SimpleShearByHand) {
    // J = 1, I1 = 3 + g^2: W = mu g^2/2, P = mu (F - (1 + g^2/3) F^-T); in xy the shear is linear.
    const double g = 0.6;
    Mat2 F;
    F << 1.0, g, 0.0, 1.0;
    const Response r = whole_of(*law_of(LawKind::neo_hookean), F);
    EXPECT_NEAR(r.energy, 0.5 * mu * g * g, 1e-15);
    EXPECT_LT((r.stress - mu * Vec4(-g * g / 3.0, g, g * (1.0 + g * g / 3.0), -g * g / 3.0)).norm(), 1e-15);
    // d2W/dg2 = mu at any shear.
    EXPECT_NEAR(r.tangent(1, 1), mu, 1e-15);
}

TEST(SaintVenantKirchhoff, UniaxialStretchByHandAndItsLimit) {
    // With e = (l^2 - 1)/2: P_xx = (lambda + 2 mu) l e, P_yy = lambda e, and dP_xx/dl = 0 at l = 1/sqrt(3).
    const auto law = law_of(LawKind::saint_venant_kirchhoff);
    const Response r = part_of(*law, stretches(0.8, 1.0));
    EXPECT_NEAR(r.energy, 0.5 * (lambda + 2.0 * mu) * 0.0324, 1e-15);
    EXPECT_NEAR(r.stress[0], -(lambda + 2.0 * mu) * 0.144, 1e-15);
    EXPECT_NEAR(r.stress[3], -lambda * 0.18, 1e-15);
    EXPECT_NEAR(part_of(*law, stretches(1.0 / std::numbers::sqrt3, 1.0)).tangent(0, 0), 0.0, 1e-14);
}

TEST(Linear, ATurnedGrainIsStrained) {
    // e = (cos a - 1) 1: W = 2 (lambda + mu) (cos a - 1)^2.
    const double shrinkage = std::cos(0.3) - 1.0;
    const Response r = part_of(*law_of(LawKind::linear), rotation(0.3));
    EXPECT_NEAR(r.energy, 2.0 * (lambda + mu) * shrinkage * shrinkage, 1e-16);
    EXPECT_NEAR(r.stress[0], 2.0 * (lambda + mu) * shrinkage, 1e-15);
}

TEST(MakeLaw, RefusesWhatItCannotDo) {
    Material material;
    material.poisson_ratio = 0.5;
    const auto message_of = [&](LawKind kind) {
        try {
            make_law(kind, material);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    for (LawKind kind : {LawKind::neo_hookean, LawKind::saint_venant_kirchhoff, LawKind::linear})
        EXPECT_NE(message_of(kind).find("poisson_ratio = 0.5"), std::string::npos);
    material.poisson_ratio = 0.499;
    EXPECT_EQ(message_of(LawKind::neo_hookean), "");
    material.yield_stress = 0.2;
    EXPECT_EQ(message_of(LawKind::neo_hookean), "");
    for (LawKind kind : {LawKind::saint_venant_kirchhoff, LawKind::linear})
        EXPECT_NE(message_of(kind).find("yield_stress = 0.2"), std::string::npos);
}

TEST(MakeLaw, OnlyAYieldStressMakesALawRemember) {
    EXPECT_TRUE(law_of(LawKind::neo_hookean, yield_stress)->remembers());
    for (LawKind kind : {LawKind::neo_hookean, LawKind::saint_venant_kirchhoff, LawKind::linear})
        EXPECT_FALSE(law_of(kind)->remembers());
}

const double radius = std::sqrt(2.0 / 3.0) * yield_stress;  // |dev tau| at yield

class VonMisesGrain : public testing::Test {
  protected:
    std::unique_ptr<GrainLaw> law_ = law_of(LawKind::neo_hookean, yield_stress);
};

TEST_F(VonMisesGrain, IsNeoHookeanIfItNeverYields) {
    const auto hard = law_of(LawKind::neo_hookean, 1e6), elastic = law_of(LawKind::neo_hookean);
    Deformations any(least_stretch, largest_stretch);
    for (int k = 0; k < 100; ++k) {
        const Mat2 F = any();
        const Response a = whole_of(*hard, F), b = whole_of(*elastic, F);
        EXPECT_EQ(a.energy, b.energy);  // the same expressions
        EXPECT_EQ(a.stress, b.stress);
        EXPECT_EQ(a.tangent, b.tangent);
    }
}

void expect_same_bits(const PlasticState& a, const PlasticState& b) {
    EXPECT_EQ(a.inverse_xx, b.inverse_xx);
    EXPECT_EQ(a.inverse_xy, b.inverse_xy);
    EXPECT_EQ(a.inverse_yy, b.inverse_yy);
    EXPECT_EQ(a.inverse_zz, b.inverse_zz);
    EXPECT_EQ(a.equivalent, b.equivalent);
    EXPECT_EQ(a.dissipated, b.dissipated);
}
double difference(const PlasticState& a, const PlasticState& b) {
    return std::abs(a.inverse_xx - b.inverse_xx) + std::abs(a.inverse_xy - b.inverse_xy) +
           std::abs(a.inverse_yy - b.inverse_yy) + std::abs(a.inverse_zz - b.inverse_zz) +
           std::abs(a.equivalent - b.equivalent);
}

TEST_F(VonMisesGrain, RemembersNothingOfStepsBelowYield) {
    // In simple shear |dev tau| = mu sqrt(2 g^2 + 2/3 g^4).
    Mat2 F = Mat2::Identity();
    const auto norm_at = [](double g) { return mu * std::sqrt(2.0 * g * g + 2.0 / 3.0 * g * g * g * g); };
    double g = 0.0;
    for (; norm_at(g) < radius * (1.0 - 1e-9); g += 1e-4) {
        F(0, 1) = g;
        expect_same_bits(flowed(*law_, F), PlasticState{});
    }
    EXPECT_GT(g, 0.05);
    F(0, 1) = g + 1e-4;
    EXPECT_GT(flowed(*law_, F).dissipated, 0.0);
}

TEST_F(VonMisesGrain, FlowEndsOnTheYieldSurfaceAndKeepsTheVolume) {
    Deformations any(least_stretch, largest_stretch);
    int count = 0;
    PlasticState state;
    for (int k = 0; k < 1000; ++k) {
        const Mat2 F = any();
        const bool beyond = flows(*law_, F, state);
        const Response during = part_of(*law_, F, state);
        state = flowed(*law_, F, state);
        EXPECT_NEAR(
            (state.inverse_xx * state.inverse_yy - state.inverse_xy * state.inverse_xy) * state.inverse_zz,
            1.0, 1e-13);  // rounding of entries up to 30
        const Response after = part_of(*law_, F, state);
        if (!beyond) continue;
        ++count;
        EXPECT_NEAR(norm_of(kirchhoff(during, F)), radius, 1e-14 * E);
        EXPECT_NEAR(norm_of(kirchhoff(after, F)), radius, 1e-13 * E);  // the slack of yielding
        EXPECT_LT((after.stress - during.stress).norm(), 1e-12 * E);
        expect_same_bits(flowed(*law_, F, state), state);  // a second flow does nothing
    }
    EXPECT_GT(count, 900);
}

TEST_F(VonMisesGrain, TakesStepsOfAnySizeAtOnce) {
    // Equivalent strains up to 3 (12 and 1/12); also stretches that are equal, or nearly.
    for (double stretch : {1.2, 1.5, 3.0, 12.0}) {
        for (double ratio : {1.0, 1.0 + 1e-15, 1.0 + 1e-9, 1.0 - 1e-5, 1.3, 1.0 / (stretch * stretch)}) {
            const Mat2 D = stretches(stretch, stretch * ratio);
            for (const Mat2& F : {D, Mat2(rotation(0.4) * D * rotation(-1.1))}) {
                ASSERT_TRUE(flows(*law_, F, {}));
                const Response r = part_of(*law_, F);
                EXPECT_NEAR(norm_of(kirchhoff(r, F)), radius, 1e-12 * E) << stretch << " " << ratio;
                EXPECT_TRUE(r.tangent.allFinite());
                EXPECT_GT(flowed(*law_, F).equivalent, 0.0);
            }
        }
    }
}

TEST_F(VonMisesGrain, TangentAtEqualAndNearlyEqualStretches) {
    for (double apart : {0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3}) {
        // Equal in the plane, and one equal to that out of the plane.
        for (const Mat2& D : {stretches(0.8, 0.8 + apart), stretches(1.3, 1.3 - apart),
                              stretches(0.8, 1.0 + apart), stretches(1.3, 1.0 - apart)}) {
            for (const Mat2& F : {D, Mat2(rotation(0.7) * D * rotation(-0.2))}) {
                ASSERT_TRUE(clear_of_yield(*law_, F, {}) && flows(*law_, F, {}));
                expect_derivatives(errors_at(*law_, F, {}));
            }
        }
    }
}

TEST_F(VonMisesGrain, ConfinedCompressionByHand) {
    // The stress keeps its direction (2, -1, -1), so that one step is as good as many. With x and y =
    // 1/sqrt(x) the elastic values of J^(-2/3) b along and across: mu (y - x) = yield stress, and the
    // equivalent plastic strain is 2/3 |log l| - |log x|/2.
    double low = 0.5, high = 1.0;
    for (int k = 0; k < 60; ++k) {
        const double x = 0.5 * (low + high);
        (mu * (1.0 / std::sqrt(x) - x) > yield_stress ? low : high) = x;
    }
    const Mat2 F = stretches(0.7, 1.0);
    const double expected = -2.0 / 3.0 * std::log(0.7) + 0.5 * std::log(low);
    const PlasticState once = flowed(*law_, F);
    EXPECT_NEAR(once.equivalent, expected, 1e-14);
    EXPECT_NEAR(once.dissipated, yield_stress * expected, 1e-15);
    const Mat2 tau = kirchhoff(part_of(*law_, F), F);
    EXPECT_NEAR(tau(1, 1) - tau(0, 0), yield_stress, 1e-14);
    PlasticState many;
    for (int k = 1; k <= 100; ++k) many = flowed(*law_, stretches(1.0 - 0.003 * k, 1.0), many);
    EXPECT_LT(difference(many, once), 1e-13);  // rounding of a hundred steps
}

TEST_F(VonMisesGrain, CompressionWithFreeSidesSaturatesAtTheLimitOfPlaneStrain) {
    // Flow goes on in the plane alone once the elastic strain stands: the stress out of the plane is then the
    // mean, dev tau = (-1, 1, 0) yield stress/sqrt(3), and tau_yy - tau_xx = 2/sqrt(3) yield stress. With
    // tau_yy = 0 that is the whole stress. What is missing falls like exp(-strain/0.044), 0.044 of
    // radius/(sqrt(8) mu): at a strain of 1.5 nothing but rounding is left.
    PlasticState state;
    double side = 1.0, along = 0.0, across = 0.0;
    for (int k = 1; k <= 300; ++k) {
        const double length = std::exp(-0.005 * k);
        for (int newton = 0; newton < 20; ++newton) {
            const Response r = whole_of(*law_, stretches(length, side), state);
            side -= r.stress[3] / r.tangent(3, 3);
        }
        const Mat2 F = stretches(length, side);
        const Mat2 tau = kirchhoff(whole_of(*law_, F, state), F);
        along = tau(0, 0);
        across = tau(1, 1);
        state = flowed(*law_, F, state);
    }
    EXPECT_NEAR(across, 0.0, 1e-14);
    EXPECT_NEAR(along, -2.0 / std::numbers::sqrt3 * yield_stress, 1e-12 * yield_stress);
}

TEST_F(VonMisesGrain, WorkIsStoredOrDissipated) {
    const auto path = [](double t) {
        Mat2 F;
        F << 1.0 + 0.2 * std::sin(t), 0.3 * t, 0.1 * std::sin(2.0 * t), 1.0 - 0.15 * std::sin(t);
        return Mat2(rotation(0.5 * t) * F);
    };
    const auto imbalance = [&](int steps) {
        PlasticState state;
        double work = 0.0;
        const double dt = 3.0 / steps;
        for (int k = 0; k < steps; ++k) {
            const Mat2 from = path(dt * k), to = path(dt * (k + 1));
            work += whole_of(*law_, 0.5 * (from + to), state).stress.dot(vector(to - from));
            state = flowed(*law_, to, state);
        }
        const Mat2 end = path(3.0);
        EXPECT_GT(state.dissipated, 0.5 * work);
        return std::abs(law_->stored(end, state) + law_->volumetric(end.determinant()).energy +
                        state.dissipated - work) /
               work;
    };
    // Every step is a minimum whose slope is P: what is left is the midpoint rule, of the square of the step
    // (1/1024), and scatters fivefold with the place in a step where flow begins or ends.
    const double coarse = imbalance(500), fine = imbalance(16000);
    EXPECT_LT(coarse, 2e-5);
    EXPECT_LT(fine, coarse / 200.0);
}

TEST_F(VonMisesGrain, TurningAfterFlowChangesNothing) {
    Deformations any(least_stretch, largest_stretch);
    for (int k = 0; k < 100; ++k) {
        const Mat2 F = any(), Q = rotation(any.angle());
        const PlasticState state = flowed(*law_, F);
        const Response here = part_of(*law_, F, state), there = part_of(*law_, Q * F, state);
        EXPECT_LT((tensor(there.stress) - Q * tensor(here.stress)).norm(), 1e-12 * E);
        EXPECT_NEAR(law_->stored(Q * F, state), law_->stored(F, state), 1e-14 * E);
        expect_same_bits(flowed(*law_, Q * F, state), state);
        // Nor does turning during the step.
        EXPECT_LT(difference(flowed(*law_, Q * F), state), 1e-12);
    }
}

TEST_F(VonMisesGrain, UnloadsElastically) {
    // The elastic range of the shear is twice radius/(sqrt(2) mu) = 0.088: 0.06 back is within it.
    Mat2 F;
    F << 1.0, 0.3, 0.0, 1.0;
    const PlasticState state = flowed(*law_, F);
    const Response loaded = part_of(*law_, F, state);
    double work = 0.0;
    const int steps = 100;
    for (int k = 0; k < steps; ++k) {
        Mat2 middle = F;
        middle(0, 1) -= 0.06 * (k + 0.5) / steps;
        expect_same_bits(flowed(*law_, middle, state), state);
        work -= part_of(*law_, middle, state).stress[1] * 0.06 / steps;
    }
    Mat2 back = F;
    back(0, 1) -= 0.06;
    // J does not change, and the energy is quadratic in the shear: the midpoint rule is exact.
    EXPECT_NEAR(law_->stored(back, state) - law_->stored(F, state), work, 1e-14);
    EXPECT_LT(part_of(*law_, back, state).stress[1], 0.5 * loaded.stress[1]);
}

TEST_F(VonMisesGrain, DissipationNeverDecreases) {
    std::mt19937_64 random(8);
    std::normal_distribution<double> part(0.0, 0.01);
    Mat2 F = Mat2::Identity();
    PlasticState state;
    int flowing = 0;
    for (int k = 0; k < 3000; ++k) {
        F += 0.05 * (Mat2::Identity() - F);
        for (int a = 0; a < 4; ++a) F(a / 2, a % 2) += part(random);
        const PlasticState next = flowed(*law_, F, state);
        EXPECT_GE(next.dissipated, state.dissipated);
        EXPECT_NEAR(next.dissipated - state.dissipated, yield_stress * (next.equivalent - state.equivalent),
                    1e-14 * next.dissipated);  // rounding of the sums
        flowing += next.dissipated > state.dissipated ? 1 : 0;
        state = next;
    }
    EXPECT_GT(flowing, 100);
    EXPECT_LT(flowing, 2900);
}

TEST(ReturnToYield, IsTheMinimumOverAllFlows) {
    // f(d) = sum exp(2 (e - d))/2 + radius |d|, on strains from 1e-8 to 3 and radii from 1e-4 to 10.
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int count = 0;
    for (int k = 0; k < 20000; ++k) {
        const double size = std::pow(10.0, -8.0 + 8.5 * unit(random));
        const double zz = std::exp(2.0 * (unit(random) - 0.5) * std::pow(10.0, -4.0 * unit(random)));
        const double most = std::pow(10.0, -4.0 + 5.0 * unit(random));
        const IsochoricStrain trial(k % 10 ? std::sinh(size) : 0.0, zz);
        if (trial.deviator().norm() < most * (1.0 + 1e-9)) continue;
        ++count;
        const YieldReturn found = return_to_yield(trial, most);
        const Deviator e = trial.logarithmic(), end = found.end.logarithmic(), stress = found.end.deviator();
        EXPECT_GT(found.flow, 0.0);
        // Rounding of strains of order 1, and of values up to 100.
        EXPECT_NEAR(e.u - end.u, found.flow * found.normal.u, 1e-14);
        EXPECT_NEAR(e.v - end.v, found.flow * found.normal.v, 1e-14);
        EXPECT_NEAR(stress.u, most * found.normal.u, 1e-14 * (1.0 + most));
        EXPECT_NEAR(stress.v, most * found.normal.v, 1e-14 * (1.0 + most));
        const auto total = [&](double u, double v) {
            double sum = most * std::hypot(u, v);
            for (double value : Deviator{e.u - u, e.v - v}.values()) sum += 0.5 * std::exp(2.0 * value);
            return sum;
        };
        const double least = total(found.flow * found.normal.u, found.flow * found.normal.v);
        EXPECT_NEAR(least, 0.5 * found.end.trace() + most * found.flow, 1e-13 * least);
        for (int a = 0; a < 6; ++a) {
            const double reach = 0.1 * found.flow, angle = std::numbers::pi / 3.0 * a;
            EXPECT_GE(total(found.flow * found.normal.u + reach * std::cos(angle),
                            found.flow * found.normal.v + reach * std::sin(angle)),
                      least * (1.0 - 1e-15));
        }
    }
    EXPECT_GT(count, 5000);
}

}  // namespace
}  // namespace softgrain::mpm
