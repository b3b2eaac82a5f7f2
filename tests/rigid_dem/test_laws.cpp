// Closed forms of the contact laws.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rigid_dem/laws/contact.hpp"
#include "rigid_dem/restitution.hpp"
#include "rigid_dem/wall_contacts.hpp"
#include "tests/rigid_dem/scenes.hpp"

namespace softgrain::rigid_dem {
namespace {

constexpr double pi = std::numbers::pi;

/// Discs that meet at +- speed until they part: time in contact, largest overlap, speed after.
struct Collision {
    double duration = 0.0, overlap = 0.0, speed = 0.0;
};
Collision collide(const Scenario& scenario, double speed, double dt) {
    const Packing p = two_discs(1e-9);
    RigidDem dem(scenario, p);
    dem.set_velocity(std::vector<Vec2>{{speed, 0.0}, {-speed, 0.0}}, std::vector<double>{0.0, 0.0});
    Collision c;
    for (bool touched = false;;) {
        dem.advance({p.box, {}}, dt);
        const GrainView view = dem.view(Need::base);
        const double overlap = 2.0 - (view.centroid[1] - view.centroid[0]).norm();
        if (touched && overlap <= 0.0) {
            c.speed = view.velocity[1].x();
            return c;
        }
        touched = touched || overlap > 0.0;
        c.overlap = std::max(c.overlap, overlap);
        if (overlap > 0.0) c.duration += dt;
    }
}

/// F = k d^(3/2): (5 m v^2 / 4 k)^(2/5) deep, 2.9432 d / v long (Landau and Lifshitz, Theory of elasticity).
TEST(Hertz, CollisionTakesTheTimeOfTheClosedForm) {
    const double nu = 0.3, speed = 1e-3;
    const Scenario s =
        scenario_with([&](Scenario&, Settings& t) { t.set("normal_law", std::string("hertz")); });
    const double modulus = 0.5 / (1.0 - nu * nu), k = 4.0 / 3.0 * modulus * std::sqrt(0.5) / 2.0;
    const double mass = 0.5 * pi, v = 2.0 * speed;
    const double deep = std::pow(1.25 * mass * v * v / k, 0.4), lasting = 2.9432 * deep / v;
    const Collision c = collide(s, speed, lasting / 2000.0);
    EXPECT_NEAR(c.overlap, deep, 1e-5 * deep);                 // second order in the step
    EXPECT_NEAR(c.duration, lasting, 2.0 * lasting / 2000.0);  // a step at either end
    EXPECT_NEAR(c.speed, speed, 1e-5 * speed);
}

TEST(Hertz, RestitutionIsTheOneAskedForAtAnySpeed) {
    for (const double e : {0.3, 0.6, 0.9})
        for (const double speed : {1e-4, 1e-2}) {
            const Scenario s = scenario_with([&](Scenario&, Settings& t) {
                t.set("normal_law", std::string("hertz"));
                t.set("restitution", e);
            });
            // The dashpot lags by half a step: first order in it.
            EXPECT_NEAR(collide(s, speed, 1e-3 * std::pow(speed, -0.2)).speed / speed, e, 2e-3);
        }
}

TEST(Restitution, NoneIsNoDashpotAndLessNeedsMore) {
    for (const auto ratio : {linear_damping_ratio, hertz_damping_ratio}) {
        EXPECT_EQ(ratio(1.0), 0.0);
        EXPECT_GT(ratio(0.5), ratio(0.9));
        EXPECT_GT(ratio(least_restitution), ratio(0.5));
    }
}

/// Mindlin 1949: k_t / k_n = 2 (1 - nu) / (2 - nu) for like spheres, the same at a wall.
TEST(Mindlin, StiffnessRatioIsThatOfLikeSpheres) {
    for (const double nu : {0.0, 0.3, 0.5}) {
        const Scenario s =
            scenario_with([&](Scenario&, Settings& t) { t.set("normal_law", std::string("hertz")); });
        const Parameters law = parameters_of(s);
        const GrainElasticity grain{0.7, 2.0, nu};
        const double expected = 2.0 * (1.0 - nu) / (2.0 - nu);
        EXPECT_NEAR(stiffness_of_pair(law, grain, grain).shear_ratio, expected, 1e-14);
        EXPECT_NEAR(stiffness_at_wall(law, grain).shear_ratio, expected, 1e-14);
    }
}

/// Slip at constant overlap: a straight line of slope k_t up to mu N, and the same slope back.
TEST(Mindlin, LoadsSlidesAndUnloadsAtConstantOverlap) {
    const LawConstants law{.friction = 0.4};
    ContactMemory memory;
    ContactInput in{.overlap = 0.04, .k = 10.0, .shear_ratio = 0.8};
    const double k_t = 0.8 * 1.5 * 10.0 * 0.2, limit = 0.4 * 10.0 * 0.04 * 0.2, step = 0.05 * limit / k_t;
    double work = 0.0, lost = 0.0, before = 0.0;
    const auto slip = [&](double by) {
        in.slip = by;
        const ContactForce f = contact_force<Hertz, has_friction>(in, memory, law, 1.0);
        work += 0.5 * (before + f.shear) * by;
        lost += f.friction_loss;
        before = f.shear;
        return f.shear;
    };
    for (int k = 1; k <= 20; ++k) EXPECT_NEAR(slip(step), 0.05 * k * limit, 1e-15);
    EXPECT_NEAR(lost, 0.0, 1e-18);
    for (int k = 0; k < 10; ++k) EXPECT_DOUBLE_EQ(slip(step), limit);
    EXPECT_NEAR(lost, 10.0 * step * limit, 1e-17);
    for (int k = 1; k <= 20; ++k) EXPECT_NEAR(slip(-step), limit - 0.05 * k * limit, 1e-15);
    EXPECT_NEAR(work, lost, 1e-17) << "nothing is stored at zero force";
}

/// As the contact opens the tangential force falls with its stiffness; it never grows by that.
TEST(Mindlin, UnloadingTakesTangentialForceAlongAndGainsNoEnergy) {
    const LawConstants law{.friction = 10.0};
    ContactMemory memory;
    ContactInput in{.overlap = 0.04, .slip = 1e-3, .k = 10.0, .shear_ratio = 0.8};
    const double held = contact_force<Hertz, has_friction>(in, memory, law, 1.0).shear;
    in.slip = 0.0;
    in.overlap = 0.01;
    const ContactForce opened = contact_force<Hertz, has_friction>(in, memory, law, 1.0);
    EXPECT_NEAR(opened.shear, 0.5 * held, 1e-16);
    EXPECT_GT(opened.friction_loss, 0.0);
    in.overlap = 0.04;
    const ContactForce closed = contact_force<Hertz, has_friction>(in, memory, law, 1.0);
    EXPECT_EQ(closed.shear, opened.shear);
    EXPECT_GT(closed.friction_loss, 0.0);
}

TEST(LinearFriction, SticksBelowTheCoulombLimitAndSlidesAbove) {
    const LawConstants law{.friction = 0.5};
    ContactMemory memory;
    ContactInput in{.overlap = 0.02, .slip = 0.002, .k = 100.0, .shear_ratio = 0.5, .shear_compliance = 0.02};
    const ContactForce stick = contact_force<Linear, has_friction>(in, memory, law, 1.0);
    EXPECT_DOUBLE_EQ(stick.shear, 0.1);
    EXPECT_DOUBLE_EQ(stick.friction_loss, 0.0);
    in.slip = 0.03;
    const ContactForce slide = contact_force<Linear, has_friction>(in, memory, law, 1.0);
    EXPECT_DOUBLE_EQ(slide.shear, 1.0);
    // work = mean force x increment; stored = (1 - 0.01) / (2 k_t); the rest is dissipated
    EXPECT_NEAR(slide.friction_loss, 0.55 * 0.03 - (1.0 - 0.01) / 100.0, 1e-15);
}

/// A disc pressed between two walls that spins: the rolling moments at both stop it at a constant rate.
TEST(Rolling, StopsASpinningDiscInTheTimeOfTheClosedForm) {
    Packing p;
    p.box.position = {-1.0, 3.0, 0.01, 1.99};
    p.center = {{1.0, 1.0}};
    p.radius = {1.0};
    const double mu = 0.1, spin = 0.02, normal = 0.01;
    const Scenario s = scenario_with([&](Scenario&, Settings& t) {
        t.set("rolling_friction", mu);
        t.set("rolling_stiffness", 100.0);
    });
    RigidDem dem(s, p);
    dem.set_velocity(std::vector<Vec2>{Vec2::Zero()}, std::vector<double>{spin});
    const double inertia = 0.5 * pi, rate = 2.0 * mu * normal / inertia;
    const double dt = 0.01, half = 0.5 * spin / rate;
    for (int k = 0; k < static_cast<int>(std::lround(half / dt)); ++k) dem.advance({p.box, {}}, dt);
    // The moment builds up over an angle of mu N / k_r R = 2e-5.
    EXPECT_NEAR(dem.spin()[0], 0.5 * spin, 0.01 * spin);
    for (int k = 0; k < static_cast<int>(std::lround(4.0 * half / dt)); ++k) dem.advance({p.box, {}}, dt);
    EXPECT_LT(std::abs(dem.spin()[0]), 0.05 * spin);
    const EnergyLedger e = dem.view(Need::base).energy;
    EXPECT_NEAR(e.friction, 0.5 * inertia * spin * spin, 0.01 * inertia * spin * spin);
}

/// Discs glued together are pulled apart: the bond holds cohesion x diameter, and its energy is lost with it.
TEST(Bond, HoldsItsStrengthAndLosesItsEnergy) {
    const LawConstants law{.adhesion = 0.3, .shear_adhesion = 1.0, .sticks = 1.0};
    ContactMemory memory;
    ContactInput in{
        .overlap = 1e-3, .k = 10.0, .shear_ratio = 0.5, .shear_compliance = 0.2, .adhesive_length = 2.0};
    constexpr unsigned parts = has_friction | has_adhesion;
    EXPECT_NEAR((contact_force<Linear, parts>(in, memory, law, 0.1).normal), 0.01, 1e-15);
    EXPECT_EQ(memory.bond, 1.0);
    in.overlap = -0.0599;  // strength 0.6
    EXPECT_NEAR((contact_force<Linear, parts>(in, memory, law, 0.1).normal), -0.599, 1e-15);
    in.overlap = -0.0601;
    const ContactForce torn = contact_force<Linear, parts>(in, memory, law, 0.1);
    EXPECT_EQ(torn.normal, 0.0);
    EXPECT_NEAR(torn.adhesion_loss, 0.5 * 10.0 * 0.0601 * 0.0601, 1e-15);
    in.overlap = -0.01;
    EXPECT_EQ((contact_force<Linear, parts>(in, memory, law, 0.1).normal), 0.0)
        << "apart it does not stick again";
    in.overlap = 1e-3;
    contact_force<Linear, parts>(in, memory, law, 0.1);
    EXPECT_EQ(memory.bond, 1.0) << "touching it does";
}

TEST(Bond, AddsItsShearStrengthToCoulombsAndSlidesWhenBroken) {
    const LawConstants law{.friction = 0.5, .adhesion = 0.3, .shear_adhesion = 0.5};
    ContactMemory memory{.bond = 1.0};
    ContactInput in{.overlap = 0.02,
                    .slip = 0.159,
                    .k = 10.0,
                    .shear_ratio = 0.5,
                    .shear_compliance = 0.2,
                    .adhesive_length = 2.0};
    constexpr unsigned parts = has_friction | has_adhesion;
    // limit 0.5 x 0.2 + 0.5 x 0.6
    EXPECT_NEAR((contact_force<Linear, parts>(in, memory, law, 0.5).shear), 0.3975, 1e-15);
    in.slip = 0.002;
    EXPECT_NEAR((contact_force<Linear, parts>(in, memory, law, 0.5).shear), 0.1, 1e-15) << "broken";
    EXPECT_EQ(memory.bond, 0.0);
}

/// On a spring: the amplitude falls by sqrt((1 - a) / (1 + a)) in half a cycle, a the share of Cundall's
/// damping: pushed back by (1 - a) k, slowed down by (1 + a) k.
TEST(NonviscousDamping, AmplitudeOfAnOscillationFallsAsInTheClosedForm) {
    Packing p;  // between two walls: k = 2 for moves along x
    p.box.position = {0.0, 1.9, -5.0, 5.0};
    p.center = {{0.97, 0.0}};
    p.radius = {1.0};
    const double share = 0.2, start = 0.02;
    const Scenario s = scenario_with([&](Scenario&, Settings& t) { t.set("nonviscous_damping", share); });
    RigidDem dem(s, p);
    const double dt = 1e-3;
    double largest_beyond = 0.0, before = 0.0;
    for (int k = 0; k < 6000; ++k) {
        dem.advance({p.box, {}}, dt);
        const GrainView view = dem.view(Need::base);
        if (view.velocity[0].x() > 0.0 && before < 0.0) break;
        before = view.velocity[0].x();
        largest_beyond = std::max(largest_beyond, 0.95 - view.centroid[0].x());
    }
    EXPECT_NEAR(largest_beyond, start * std::sqrt((1.0 - share) / (1.0 + share)), 1e-3 * start);
    const EnergyLedger e = dem.view(Need::base).energy;
    EXPECT_NEAR(e.damping, start * start - largest_beyond * largest_beyond, 1e-3 * start * start);
}

/// A grain that slides, spins and presses on the bottom wall, over two steps.
std::array<double, 8> at_wall(bool hertz, unsigned features, const LawConstants& law) {
    const WallMotion walls{Box{}, {}, 0.0};
    const std::vector<GrainRecord> grain{{.x = 0.5,
                                          .y = 0.24,
                                          .vx = 0.3,
                                          .vy = -0.2,
                                          .spin = 0.7,
                                          .radius = 0.25,
                                          .rim_speed = 0.175,
                                          .inverse_mass = 2.0}};
    std::vector<WallContact> contacts{{0, 2, {1.5, 0.5}, {}}};
    std::vector<ForceSum> force(1);
    const WallKernel kernel = wall_kernel(hertz, features);
    kernel(contacts, grain, force, walls, law, 0.01);
    const WallSums sums = kernel(contacts, grain, force, walls, law, 0.01);
    return {force[0].fx,       force[0].fy,       force[0].shear,     force[0].lost_torque,
            sums.force[2].x(), sums.force[2].y(), sums.friction_loss, sums.damping_loss};
}

TEST(AtWalls, PartsThatAreLeftOutHadNoEffect) {
    constexpr unsigned all = has_damping | has_friction | has_rolling;
    for (const bool hertz : {false, true}) {
        LawConstants law;
        EXPECT_EQ(at_wall(hertz, no_part, law), at_wall(hertz, all, law));
        law.damping = 0.4;
        EXPECT_EQ(at_wall(hertz, has_damping, law), at_wall(hertz, all, law));
        law.friction = 0.3;
        EXPECT_EQ(at_wall(hertz, has_damping | has_friction, law), at_wall(hertz, all, law));
        EXPECT_NE(at_wall(hertz, has_damping, law), at_wall(hertz, all, law));
        law.rolling_friction = law.rolling_stiffness = 0.2;
        EXPECT_NE(at_wall(hertz, has_damping | has_friction, law), at_wall(hertz, all, law));
    }
}

}  // namespace
}  // namespace softgrain::rigid_dem
