// Places on curves, contact forces, and what Newton's method is told about them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "discs.hpp"
#include "mpm/contact/closest_point.hpp"
#include "mpm/contact/contact_model.hpp"
#include "mpm/contact/contacts.hpp"
#include "mpm/contact/grain_contacts.hpp"
#include "mpm/disc/quadratic_spline.hpp"

namespace softgrain::mpm {
namespace {

constexpr double pi = std::numbers::pi;

Vec2 curve(const std::vector<Vec2>& control, double u) {
    const auto n = static_cast<int>(control.size());
    const double whole = std::floor(u);
    const SplineSpan s = spline_span(u - whole);
    Vec2 x = Vec2::Zero();
    for (int k = 0; k < 3; ++k)
        x += s.value[static_cast<std::size_t>(k)] *
             control[static_cast<std::size_t>(((static_cast<int>(whole) + k) % n + n) % n)];
    return x;
}

/// Nearest place by dense sampling, then by golden section: the distance is good to rounding.
struct Nearest {
    double u, distance;
    bool inside;
};
class DenseCurve {
  public:
    explicit DenseCurve(std::vector<Vec2> control) : control_(std::move(control)) {
        for (std::size_t k = 0; k < control_.size() * per_span; ++k)
            sample_.push_back(curve(control_, static_cast<double>(k) / per_span));
    }
    const std::vector<Vec2>& control() const { return control_; }

    Nearest nearest(const Vec2& p) const {
        std::size_t best = 0;
        double turned = 0.0;
        for (std::size_t k = 0; k < sample_.size(); ++k) {
            const Vec2 a = sample_[k] - p, b = sample_[(k + 1) % sample_.size()] - p;
            turned += std::atan2(cross(a, b), a.dot(b));
            if (a.squaredNorm() < (sample_[best] - p).squaredNorm()) best = k;
        }
        const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
        double low = (static_cast<double>(best) - 1.0) / per_span,
               high = (static_cast<double>(best) + 1.0) / per_span;
        while (high - low > 1e-9) {
            const double a = high - golden * (high - low), b = low + golden * (high - low);
            if ((curve(control_, a) - p).squaredNorm() < (curve(control_, b) - p).squaredNorm())
                high = b;
            else
                low = a;
        }
        const double u = 0.5 * (low + high);
        return {u, (curve(control_, u) - p).norm(), std::abs(turned) > pi};
    }

  private:
    static constexpr std::size_t per_span = 16;
    std::vector<Vec2> control_, sample_;
};

std::vector<Vec2> controls_of(const ReferenceDisc& disc, const std::vector<Vec2>& q) {
    std::vector<Vec2> control;
    for (std::size_t k = 0; k < disc.control.size(); ++k) control.push_back(disc.control.at(k, q));
    return control;
}
/// The surface of a bent disc of radius 1.
std::vector<Vec2> bent_surface(int cells, double size, std::mt19937_64& random) {
    const Grains grains = test::grains_of(cells, {Mat2::Identity()});
    std::vector<Vec2> q = test::nodes_at(grains, {Vec2::Zero()});
    test::bend(grains, size, random, q);
    q = test::sum(q, 0.02 * grains.disc->spacing(), test::random_nodes(q.size(), 1.0, random));
    return controls_of(*grains.disc, q);
}

TEST(ClosestPlace, IsThatOfTheCircleForTheUndeformedDisc) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> angle(-pi, pi), radius(0.5, 2.0);
    for (const int cells : {2, 4, 9}) {
        const auto disc = reference_disc(cells);
        const std::vector<Vec2> control = controls_of(*disc, disc->coordinate);
        const double a = pi / static_cast<double>(control.size()), off = std::pow(a, 4) / 8.0;
        for (int k = 0; k < 2000; ++k) {
            const double turn = angle(random), r = radius(random);
            const Vec2 out{std::cos(turn), std::sin(turn)};
            const CurvePlace place = closest_place(control, r * out);
            // The curve is inside the circle by up to a^4/8, tilts by a^3, and is that much less curved.
            EXPECT_GE(place.gap, r - 1.0 - 1e-14);
            EXPECT_LE(place.gap, r - 1.0 + 1.01 * off);
            EXPECT_LT((place.normal - out).norm(), 2.0 * a * a * a);
            EXPECT_NEAR(place.speed, 2.0 * a, 2.0 * a * a * a);
            EXPECT_NEAR(place.curvature, -place.speed * place.speed, 4.0 * std::pow(a, 4));
        }
    }
}

TEST(ClosestPlace, FrameIsThatOfTheCurve) {
    std::mt19937_64 random(2);
    const std::vector<Vec2> control = bent_surface(4, 0.08, random);
    for (int k = 0; k < 500; ++k) {
        const Vec2 p = 1.2 * test::random_vector(random, 1.0).normalized();
        const CurvePlace place = closest_place(control, p);
        EXPECT_GE(place.span, 0);
        EXPECT_LT(place.span, static_cast<int>(control.size()));
        EXPECT_GE(place.t, 0.0);
        EXPECT_LE(place.t, 1.0);
        const double u = place.span + place.t;
        const Vec2 foot = curve(control, u);
        EXPECT_LT((foot + place.gap * place.normal - p).norm(), 1e-13);  // at right angles
        EXPECT_NEAR(place.normal.norm(), 1.0, 1e-15);
        EXPECT_LT((perpendicular(place.normal) - place.tangent).norm(), 1e-15);
        // Parabola: differences within the span are exact, but for rounding over the step.
        const double step = 0.5 * std::min(place.t, 1.0 - place.t);
        if (step < 0.01) continue;
        const Vec2 before = curve(control, u - step), after = curve(control, u + step);
        EXPECT_LT((place.speed * place.tangent - (after - before) / (2.0 * step)).norm(), 1e-13);
        EXPECT_NEAR(place.curvature, place.normal.dot(after - 2.0 * foot + before) / (step * step), 1e-10);
    }
}

TEST(ClosestPlace, IsTheNearestOfBentCurves) {
    std::mt19937_64 random(3);
    int inside = 0, outside = 0;
    for (int k = 0; k < 40; ++k) {
        const DenseCurve dense(bent_surface(2 + k % 4, 0.08, random));
        for (int m = 0; m < 50; ++m) {
            const Vec2 p = test::random_vector(random, 1.4);
            const Nearest nearest = dense.nearest(p);
            // Deep inside several places are as near; nothing is pressed in that far.
            if (nearest.inside && nearest.distance > 0.3) continue;
            const CurvePlace place = closest_place(dense.control(), p);
            const double gap = nearest.inside ? -nearest.distance : nearest.distance;
            EXPECT_NEAR(place.gap, gap, 1e-14) << k << ", " << p.transpose();
            (nearest.inside ? inside : outside) += 1;
        }
    }
    EXPECT_GT(std::min(inside, outside), 300);
}

TEST(ClosestPlace, MovesWithThePoint) {
    std::mt19937_64 random(4);
    for (int k = 0; k < 20; ++k) {
        const std::vector<Vec2> control = bent_surface(3, 0.05, random);
        // Across the surface, in and out again; the deepest is 0.25.
        const double angle = 0.3 * k;
        const Vec2 along{-std::sin(angle), std::cos(angle)}, out{std::cos(angle), std::sin(angle)};
        const int steps = 4000;
        const double length = 2.4 / steps;
        CurvePlace last{};
        for (int s = 0; s <= steps; ++s) {
            const Vec2 p = 0.75 * out + (length * s - 1.2) * along;
            const CurvePlace place = closest_place(control, p);
            if (s > 0) {
                // dgap = normal . dp; normals turn by less than 6 a length.
                const double expected = 0.5 * length * (last.normal + place.normal).dot(along);
                EXPECT_NEAR(place.gap - last.gap, expected, 6.0 * length * length / 4.0);
                EXPECT_LT((place.normal - last.normal).norm(), 6.0 * length);
            }
            last = place;
        }
    }
}

/// A packing with its contacts.
class Scene {
  public:
    explicit Scene(unsigned seed, int rows = 2, int columns = 2)
        : packing_(4, rows, columns, 0.04, seed),
          contacts_(packing_.grains, penalty),
          model_(packing_.grains) {
        evaluate(packing_.q);
    }
    static constexpr double penalty = 200.0;

    double evaluate(const std::vector<Vec2>& q) { return evaluate(q, packing_.box); }
    double evaluate(const std::vector<Vec2>& q, const Box& box) {
        surfaces_.update(packing_.grains, q);
        force_.assign(q.size(), Vec2::Zero());
        return contacts_.evaluate(surfaces_, box, force_);
    }
    const Grains& grains() const { return packing_.grains; }
    const std::vector<Vec2>& q() const { return packing_.q; }
    const Box& box() const { return packing_.box; }
    const Surfaces& surfaces() const { return surfaces_; }
    const Contacts& contacts() const { return contacts_; }
    /// Of the last evaluate().
    const std::vector<Vec2>& force() const { return force_; }
    ContactModel& model() { return model_; }
    /// Of the same point and grain or wall, at the last evaluate().
    double gap_of(const PointContact& c) const {
        const Vec2& x =
            surfaces_.points_of(grains(), static_cast<std::size_t>(c.i))[static_cast<std::size_t>(c.point)];
        if (c.j < 0) return box().distance(-1 - c.j, x);
        return closest_place(surfaces_.controls_of(grains(), static_cast<std::size_t>(c.j)), x).gap;
    }

    /// Whether no point begins or ends to touch, or changes to another span, within these margins [m],
    /// [span].
    bool clear(double of_zero, double of_knots) const {
        return std::all_of(contacts_.points().begin(), contacts_.points().end(), [&](const PointContact& c) {
            if (std::abs(c.place.gap) < of_zero) return false;
            return !c.touches() || c.j < 0 || std::min(c.place.t, 1.0 - c.place.t) > of_knots;
        });
    }

  private:
    test::Packing packing_;
    Surfaces surfaces_;
    Contacts contacts_;
    ContactModel model_;
    std::vector<Vec2> force_;
};

std::unique_ptr<Scene> clear_scene(double of_zero, double of_knots) {
    for (unsigned seed = 1; seed < 200; ++seed) {
        auto scene = std::make_unique<Scene>(seed);
        if (scene->clear(of_zero, of_knots)) return scene;
    }
    throw std::logic_error("no scene is clear");
}

/// How the parts of a touching point change with d: dg, and -d2g by the formula of its second variation.
struct Variation {
    double first, second;
};
Variation variation(const Scene& scene, const PointContact& c, const Surfaces& d) {
    const auto controls = static_cast<int>(scene.grains().disc->control.size());
    const Vec2 move =
        d.points_of(scene.grains(), static_cast<std::size_t>(c.i))[static_cast<std::size_t>(c.point)];
    if (c.j < 0) return {c.place.normal.dot(move), 0.0};
    const SplineSpan s = spline_span(c.place.t);
    Vec2 place = Vec2::Zero(), slope = Vec2::Zero();
    for (int k = 0; k < 3; ++k) {
        const Vec2& x = d.controls_of(
            scene.grains(),
            static_cast<std::size_t>(c.j))[static_cast<std::size_t>((c.place.span + k) % controls)];
        place += s.value[static_cast<std::size_t>(k)] * x;
        slope += s.slope[static_cast<std::size_t>(k)] * x;
    }
    const double L = c.place.speed, kappa = c.place.curvature, g = c.place.gap;
    const double b = c.place.tangent.dot(move - place), beta = c.place.normal.dot(slope);
    return {c.place.normal.dot(move - place),
            (kappa * b * b + 2.0 * L * b * beta + g * beta * beta) / (L * L - g * kappa)};
}

TEST(Contacts, ForceIsTheDerivativeOfTheEnergy) {
    const auto scene = clear_scene(1e-5, 1e-4);
    const std::vector<Vec2> force = scene->force();
    std::mt19937_64 random(5);
    for (int k = 0; k < 10; ++k) {
        const auto d = test::random_nodes(force.size(), 1.0, random);
        const double step = 1e-6;
        const double slope = (scene->evaluate(test::sum(scene->q(), step, d)) -
                              scene->evaluate(test::sum(scene->q(), -step, d))) /
                             (2.0 * step);
        // Rounding of the energy over the step: 1e-16 of 1 over 1e-6.
        EXPECT_NEAR(slope, test::dot(force, d), 1e-9 * test::norm(force));
    }
}

TEST(Contacts, ActionIsReaction) {
    // Without walls.
    Scene scene(1, 2, 3);
    scene.evaluate(scene.q(), Box{{-9.0, 9.0, -9.0, 9.0}});
    ASSERT_GE(scene.contacts().groups().size(), 8U);
    Vec2 sum = Vec2::Zero();
    double moment = 0.0, size = 0.0;
    for (std::size_t m = 0; m < scene.q().size(); ++m) {
        sum += scene.force()[m];
        moment += cross(scene.q()[m], scene.force()[m]);
        size += scene.force()[m].norm();
    }
    EXPECT_GT(size, 1.0);
    EXPECT_LT(sum.norm(), 1e-15 * size);
    // The arm is along the normal to 1e-13 of a span.
    EXPECT_LT(std::abs(moment), 1e-14 * size);
}

TEST(Contacts, EachPairBalances) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Scene scene(seed, 1, 2);
        scene.evaluate(scene.q(), Box{{-9.0, 9.0, -9.0, 9.0}});
        ASSERT_EQ(scene.contacts().groups().size(), 1U);
        std::array<Vec2, 2> sum{Vec2::Zero(), Vec2::Zero()};
        std::array<double, 2> moment{};
        const std::size_t nodes = scene.grains().nodes();
        for (std::size_t m = 0; m < 2 * nodes; ++m) {
            sum[m / nodes] += scene.force()[m];
            moment[m / nodes] += cross(scene.q()[m], scene.force()[m]);
        }
        EXPECT_GT(sum[0].norm(), 0.01);
        EXPECT_LT((sum[0] + sum[1]).norm(), 1e-13 * sum[0].norm());
        EXPECT_LT(std::abs(moment[0] + moment[1]), 1e-13 * sum[0].norm());
        Vec2 of_points = Vec2::Zero();
        for (const PointContact& c : scene.contacts().points())
            of_points += (c.i == 0 ? c.force() : -c.force()) * c.place.normal;
        EXPECT_LT((of_points + sum[0]).norm(), 1e-13 * sum[0].norm());
    }
}

TEST(Contacts, WallForceIsMinusTheForceOnTheGrainAndTheDerivativeByTheWall) {
    for (std::size_t wall = 0; wall < 4; ++wall) {
        Scene scene(7, 1, 1);
        Box box{{-9.0, 9.0, -9.0, 9.0}};
        box.position[wall] = scene.box().position[wall];
        scene.evaluate(scene.q(), box);
        const Vec2 on_wall = scene.contacts().wall_force()[wall];
        Vec2 slope = Vec2::Zero();
        for (const Vec2& f : scene.force()) slope += f;
        EXPECT_GT(-on_wall.dot(wall_normal(static_cast<int>(wall))), 0.1);
        EXPECT_LT((on_wall - slope).norm(), 1e-14 * slope.norm());  // force on grain = -slope
        const auto energy_at = [&](double by) {
            Box moved = box;
            moved.position[wall] += by;
            return scene.evaluate(scene.q(), moved);
        };
        // A point that begins to touch within the step adds k step/2.
        const double step = 1e-6, derivative = (energy_at(step) - energy_at(-step)) / (2.0 * step);
        EXPECT_NEAR(on_wall[wall_axis(static_cast<int>(wall))], -derivative, 1e-6 * on_wall.norm());
    }
}

TEST(Contacts, PressureIsPenaltyTimesModulusOverSpacing) {
    // Of a disc on a wall: penalty E'/(h R) times its overlap depth - R (1 - cos(angle)).
    for (const double R : {0.5, 2.0}) {
        const Grains grains = test::grains_of(8, {Mat2(R * Mat2::Identity())});
        Contacts contacts(grains, 100.0);
        Surfaces surfaces;
        const double depth = 0.03 * R;
        const std::vector<Vec2> q = test::nodes_at(grains, {Vec2{R - depth, 0.0}});
        surfaces.update(grains, q);
        std::vector<Vec2> force(q.size(), Vec2::Zero());
        contacts.evaluate(surfaces, Box{{0.0, 10.0, -5.0, 5.0}}, force);
        const double half = std::acos(1.0 - depth / R), modulus = 1.0 / (1.0 - 0.3 * 0.3);
        const double expected = 100.0 * modulus / (grains.disc->spacing() * R) * 2.0 * R *
                                (R * std::sin(half) - (R - depth) * half);
        // Sum over 64 points where the pressure ends in a slope.
        EXPECT_NEAR(-contacts.wall_force()[0].x(), expected, 1e-3 * expected);
    }
}

TEST(Contacts, SpringOfAPairIsTheMeanOfItsGrains) {
    Grains grains = test::grains_of(4, {Mat2(0.5 * Mat2::Identity()), Mat2(0.7 * Mat2::Identity())});
    grains.grain[1].modulus *= 3.0;
    Contacts contacts(grains, 50.0);
    Surfaces surfaces;
    surfaces.update(grains, test::nodes_at(grains, {Vec2::Zero(), Vec2{1.18, 0.0}}));
    std::vector<Vec2> force(grains.all_nodes(), Vec2::Zero());
    contacts.evaluate(surfaces, Box{{-9.0, 9.0, -9.0, 9.0}}, force);
    const double compliance = 0.5 * (0.5 / grains.grain[0].modulus + 0.7 / grains.grain[1].modulus);
    const double weight = grains.disc->surface_weight();
    int first = 0, second = 0;
    for (const PointContact& c : contacts.points()) {
        const double length =
            0.5 * weight * grains.grain[static_cast<std::size_t>(c.i)].radius;  // two passes
        EXPECT_NEAR(c.stiffness, 50.0 * length / (0.25 * compliance), 1e-12 * c.stiffness);
        (c.i == 0 ? first : second) += c.touches();
    }
    EXPECT_GT(std::min(first, second), 5);
}

TEST(Contacts, AreThoseOfAllPointsAgainstAllGrains) {
    // One grain goes through all others, which wander: lists go stale, pairs come and go.
    Scene scene(8, 2, 3);
    std::mt19937_64 random(8);
    const Grains& grains = scene.grains();
    std::vector<Vec2> drift;
    for (std::size_t g = 0; g < grains.size(); ++g) drift.push_back(test::random_vector(random, 0.02));
    drift[0] = {0.09, 0.03};
    std::vector<Vec2> q = scene.q();
    std::size_t most = 0, least = 100;
    for (int step = 0; step < 20; ++step) {
        for (std::size_t m = 0; m < q.size(); ++m) q[m] += drift[m / grains.nodes()];
        const double energy = scene.evaluate(q);
        using Key = std::tuple<int, int, int>;
        std::vector<Key> touching, listed;
        double expected = 0.0;
        for (std::size_t i = 0; i < grains.size(); ++i) {
            const auto points = scene.surfaces().points_of(grains, i);
            const double length = grains.disc->surface_weight() * grains.grain[i].radius;
            for (std::size_t k = 0; k < points.size(); ++k) {
                const auto meet = [&](int j, double gap, double per_length) {
                    if (gap >= 0.0) return;
                    touching.emplace_back(static_cast<int>(i), static_cast<int>(k), j);
                    expected += 0.5 * per_length * gap * gap;
                };
                const auto spring = [&](std::size_t j) {
                    return 2.0 * Scene::penalty * grains.grain[0].modulus /
                           (grains.disc->spacing() * (grains.grain[i].radius + grains.grain[j].radius));
                };
                for (int wall = 0; wall < 4; ++wall)
                    meet(-1 - wall, scene.box().distance(wall, points[k]), length * spring(i));
                for (std::size_t j = 0; j < grains.size(); ++j)
                    if (j != i)
                        meet(static_cast<int>(j),
                             closest_place(scene.surfaces().controls_of(grains, j), points[k]).gap,
                             0.5 * length * spring(j));
            }
        }
        for (const PointContact& c : scene.contacts().points())
            if (c.touches()) listed.emplace_back(c.i, c.point, c.j);
        std::sort(listed.begin(), listed.end());
        std::sort(touching.begin(), touching.end());
        EXPECT_EQ(listed, touching);
        EXPECT_NEAR(energy, expected, 1e-13 * expected);
        most = std::max(most, scene.contacts().groups().size());
        least = std::min(least, scene.contacts().groups().size());
    }
    EXPECT_GE(most, least + 3);
}

TEST(Contacts, GroupsAreInOrder) {
    const Scene scene(9, 2, 3);
    int next = 0;
    std::pair<int, int> last{-1, 0};
    for (const ContactGroup& group : scene.contacts().groups()) {
        EXPECT_LT(last, (std::pair{group.i, group.j}));
        last = {group.i, group.j};
        EXPECT_EQ(group.first, next);
        EXPECT_GT(group.count, 0);
        next += group.count;
        bool second = false;
        for (int p = group.first; p < next; ++p) {
            const PointContact& c = scene.contacts().points()[static_cast<std::size_t>(p)];
            second = second || c.i != group.i;
            EXPECT_EQ(c.i, second ? group.j : group.i);
            EXPECT_EQ(c.j, second ? group.i : group.j);
        }
    }
    EXPECT_EQ(static_cast<std::size_t>(next), scene.contacts().points().size());
}

TEST(GrainContacts, SumThePointsOfEachPair) {
    const Scene scene(10, 2, 2);
    const auto pairs = sum_grain_contacts(scene.grains(), scene.surfaces(), scene.contacts());
    EXPECT_GE(pairs.size(), 8U);
    std::vector<Vec2> on_grain(scene.grains().size(), Vec2::Zero());
    std::pair<int, int> last{-1, 0};
    for (const GrainContact& c : pairs) {
        EXPECT_LT(last, (std::pair{c.i, c.j}));
        last = {c.i, c.j};
        on_grain[static_cast<std::size_t>(c.i)] += c.force;
        if (!c.with_wall()) on_grain[static_cast<std::size_t>(c.j)] -= c.force;
        EXPECT_NEAR(c.normal_force(), c.force.norm(), 1e-14 * c.force.norm());
        EXPECT_NEAR(c.normal.norm(), 1.0, 1e-15);
        if (c.with_wall()) {
            EXPECT_LT((c.normal + wall_normal(c.wall())).norm(), 1e-15);
        }
    }
    std::vector<Vec2> slope(scene.grains().size(), Vec2::Zero());
    for (std::size_t m = 0; m < scene.q().size(); ++m) slope[m / scene.grains().nodes()] += scene.force()[m];
    for (std::size_t g = 0; g < slope.size(); ++g)
        EXPECT_LT((on_grain[g] + slope[g]).norm(), 1e-13 * test::norm(scene.force()));
}

TEST(GrainContacts, MeasureADiscOnAWallAndOnAnother) {
    // Depth d: half-angle a with cos a = 1 - d/R for the wall, 1 - d/(2 R) for the other disc.
    const double R = 0.5, depth = 0.02;
    const Grains grains = test::grains_of(8, {Mat2(R * Mat2::Identity()), Mat2(R * Mat2::Identity())});
    Contacts contacts(grains, 100.0);
    Surfaces surfaces;
    std::vector<Vec2> force(grains.all_nodes(), Vec2::Zero());
    for (const bool wall : {true, false}) {
        surfaces.update(grains, test::nodes_at(grains, {Vec2{R - depth, 0.0},
                                                        Vec2{wall ? 3.0 : 3.0 * R - 2.0 * depth, 0.0}}));
        contacts.evaluate(surfaces, Box{{wall ? 0.0 : -3.0, 5.0, -5.0, 5.0}}, force);
        const auto pairs = sum_grain_contacts(grains, surfaces, contacts);
        ASSERT_EQ(pairs.size(), 1U);
        const double a = std::acos(1.0 - (wall ? depth : 0.5 * depth) / R);
        const double segment = R * R * (a - std::sin(a) * std::cos(a));
        // Whole points, R pi/416 apart, at both ends.
        EXPECT_NEAR(pairs[0].length, 2.0 * a * R, 2.0 * R * pi / 416.0);
        // Gaps are taken along the surface, not along the chord.
        const double area = wall ? segment : 2.0 * segment;
        EXPECT_NEAR(overlap_area(surfaces, contacts, grains), area, area * (1.0 / std::cos(a) - 1.0));
        EXPECT_NEAR(deepest_overlap(contacts), depth, 1e-3 * depth);  // half a spacing beside it
        if (wall) {
            EXPECT_LT(std::abs(pairs[0].point.x() + 0.5 * depth), 0.5 * depth);  // of surface points
        } else {
            EXPECT_NEAR(pairs[0].point.x(), 2.0 * R - 1.5 * depth, 1e-13);  // in the middle
        }
        EXPECT_NEAR(pairs[0].point.y(), 0.0, 1e-13);
    }
    surfaces.update(grains, test::nodes_at(grains, {Vec2{0.0, 0.0}, Vec2{3.0, 0.0}}));
    contacts.evaluate(surfaces, Box{{-5.0, 5.0, -5.0, 5.0}}, force);
    EXPECT_TRUE(sum_grain_contacts(grains, surfaces, contacts).empty());
    EXPECT_EQ(deepest_overlap(contacts), 0.0);
    EXPECT_EQ(overlap_area(surfaces, contacts, grains), 0.0);
}

/// K d of the groups, from lower triangles.
std::vector<Vec2> times(const std::vector<ContactStiffness>& groups, const std::vector<Vec2>& d) {
    std::vector<Vec2> out(d.size(), Vec2::Zero());
    for (const ContactStiffness& K : groups) {
        const auto size = static_cast<Eigen::Index>(2 * K.node.size());
        Eigen::VectorXd x(size);
        for (std::size_t k = 0; k < K.node.size(); ++k)
            x.segment<2>(static_cast<Eigen::Index>(2 * k)) = d[static_cast<std::size_t>(K.node[k])];
        const Eigen::VectorXd y = K.matrix.selfadjointView<Eigen::Lower>() * x;
        for (std::size_t k = 0; k < K.node.size(); ++k)
            out[static_cast<std::size_t>(K.node[k])] += y.segment<2>(static_cast<Eigen::Index>(2 * k));
    }
    return out;
}

TEST(ContactModel, HasTheForceAndTheEnergyOfNow) {
    Scene scene(10);
    const double energy = scene.evaluate(scene.q());
    scene.model().build(scene.contacts());
    ASSERT_EQ(scene.model().points(), scene.contacts().points().size());
    std::vector<Touch> active;
    scene.model().find_active({}, active);
    for (std::size_t p = 0; p < active.size(); ++p)
        EXPECT_EQ(active[p].presses, scene.contacts().points()[p].touches());
    std::vector<Vec2> force(scene.q().size(), Vec2{1.0, -1.0});
    scene.model().add_force(active, force);
    const double size = test::norm(scene.force());
    for (std::size_t m = 0; m < force.size(); ++m)
        EXPECT_LT((force[m] - Vec2{1.0, -1.0} + scene.force()[m]).norm(), 1e-15 * size);
    const std::vector<Vec2> still(force.size(), Vec2::Zero());
    EXPECT_NEAR(scene.model().energy(still), energy, 1e-14 * energy);
}

TEST(ContactModel, StiffnessIsTheDerivativeOfTheForcesWithAllOfItsSecondVariation) {
    const auto scene = clear_scene(1e-5, 1e-4);
    scene->model().build(scene->contacts());
    std::vector<Touch> active;
    scene->model().find_active({}, active);
    std::vector<ContactStiffness> K;
    scene->model().find_stiffness(active, K);
    ASSERT_EQ(K.size(), scene->contacts().groups().size());
    for (const ContactStiffness& group : K)
        EXPECT_TRUE(std::is_sorted(group.node.begin(), group.node.end(), std::less_equal<>()));
    const std::vector<PointContact> points(scene->contacts().points().begin(),
                                           scene->contacts().points().end());
    std::mt19937_64 random(11);
    double missing = 0.0;
    for (int k = 0; k < 20; ++k) {
        auto d = test::random_nodes(scene->q().size(), 1.0, random);
        // Half of them slide without much change of the gaps: the rows of grains against each other.
        if (k % 2)
            for (std::size_t m = 0; m < d.size(); ++m)
                d[m] = 0.1 * d[m] + perpendicular(scene->q()[m % scene->grains().nodes()]);
        const double step = 1e-6;
        scene->evaluate(test::sum(scene->q(), step, d));
        const std::vector<Vec2> above = scene->force();
        scene->evaluate(test::sum(scene->q(), -step, d));
        std::vector<Vec2> slope = test::sum(above, -1.0, scene->force());
        for (Vec2& f : slope) f /= 2.0 * step;
        const std::vector<Vec2> ours = times(K, d);
        // Rounding of forces of order 1 over the step.
        EXPECT_LT(test::norm(test::sum(ours, -1.0, slope)), 1e-8 * test::norm(slope));
        Surfaces moved;
        moved.update(scene->grains(), d);
        double first = 0.0, second = 0.0;
        for (const PointContact& c : points) {
            if (!c.touches()) continue;
            const Variation v = variation(*scene, c, moved);
            first += c.stiffness * v.first * v.first;
            second += c.force() * v.second;
        }
        const double whole = test::dot(d, slope);
        EXPECT_NEAR(first + second, whole, 1e-8 * std::abs(whole));
        missing = std::max(missing, std::abs(first - whole) / std::abs(whole));
    }
    EXPECT_GT(missing, 0.1);  // without it the comparison would fail by far
}

TEST(ContactModel, EnergyIsGoodToThirdOrder) {
    const auto scene = clear_scene(4e-5, 1e-3);
    scene->model().build(scene->contacts());
    std::vector<Touch> active;
    scene->model().find_active({}, active);
    std::vector<ContactStiffness> K;
    scene->model().find_stiffness(active, K);
    const double now = scene->evaluate(scene->q());
    const std::vector<Vec2> force = scene->force();
    std::mt19937_64 random(12);
    for (int k = 0; k < 10; ++k) {
        const auto d = test::random_nodes(force.size(), 1.0, random);
        const std::vector<Vec2> Kd = times(K, d);
        std::array<double, 3> error{};
        for (std::size_t s = 0; s < 3; ++s) {
            const double size = 1e-5 * std::pow(2.0, static_cast<double>(s));
            const std::vector<Vec2> move = test::sum(std::vector<Vec2>(d.size(), Vec2::Zero()), size, d);
            const double foreseen = scene->model().energy(move);
            // Where no point begins to touch it is its own second-order expansion.
            EXPECT_NEAR(foreseen, now + test::dot(force, move) + 0.5 * size * test::dot(Kd, move),
                        1e-14 * now);
            error[s] = scene->evaluate(test::sum(scene->q(), 1.0, move)) - foreseen;
        }
        // Third order: eightfold each time, up to the next order.
        EXPECT_NEAR(error[1] / error[0], 8.0, 0.8);
        EXPECT_NEAR(error[2] / error[1], 8.0, 0.8);
    }
}

TEST(ContactModel, ForeseesWhichPointsWillTouch) {
    std::mt19937_64 random(13);
    int switched = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Scene scene(seed);
        scene.model().build(scene.contacts());
        const std::vector<PointContact> points(scene.contacts().points().begin(),
                                               scene.contacts().points().end());
        const double size = 1e-3;
        std::vector<Vec2> d = test::random_nodes(scene.q().size(), 0.2 * size, random);
        for (std::size_t g = 0; g < scene.grains().size(); ++g) {
            const Vec2 move = test::random_vector(random, 0.5 * size);
            for (Vec2& x : scene.grains().of(d, g)) x += move;
        }
        std::vector<Touch> foreseen;
        scene.model().find_active(d, foreseen);
        Surfaces moved;
        moved.update(scene.grains(), d);
        scene.evaluate(test::sum(scene.q(), 1.0, d));
        int touching = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            const PointContact& c = points[p];
            const double linear = c.place.gap + variation(scene, c, moved).first, gap = scene.gap_of(c);
            EXPECT_EQ(foreseen[p].presses, linear < 0.0);
            // Of second order: b^2/(2 R) of relative motions b up to 1.4 size, and b times turns of nodes
            // apart.
            EXPECT_NEAR(gap, linear, 6.0 * size * size);
            touching += gap < 0.0;
            switched += (gap < 0.0) != c.touches();
        }
        // None touches that was not listed.
        for (const PointContact& c : scene.contacts().points()) touching -= c.touches();
        EXPECT_EQ(touching, 0);
    }
    EXPECT_GT(switched, 20);
}

}  // namespace
}  // namespace softgrain::mpm
