// Coulomb friction: its energy and its bounds, and the search for which points slide.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "mpm/contact/friction.hpp"
#include "mpm/contact/model_search.hpp"
#include "tests/mpm/discs.hpp"

namespace softgrain::mpm {
namespace {

/// A small packing that has moved since friction began.
struct Scene {
    test::Packing packing{4, 2, 2, 0.04, 3};
    Contacts contacts{packing.grains, 200.0};
    Friction friction{packing.grains, 0.5, 0.3};
    Surfaces surfaces;
    std::vector<Vec2> force;
    std::mt19937_64 random{5};

    /// Lagged at the packing, begun where it was turned by `size` before.
    explicit Scene(double size) {
        std::vector<Vec2> before = packing.q;
        const std::size_t nodes = packing.grains.nodes();
        for (std::size_t m = 0; m < before.size(); ++m) {
            const double turn = (m / nodes) % 2 == 0 ? size : -0.3 * size;
            before[m] -= turn * perpendicular(before[m]);
        }
        surfaces.update(packing.grains, before);
        friction.begin(surfaces);
        evaluate_contacts();
        friction.lag(contacts);
    }
    void evaluate_contacts() {
        surfaces.update(packing.grains, packing.q);
        force.assign(packing.q.size(), Vec2::Zero());
        contacts.evaluate(surfaces, packing.box, force);
    }
    double evaluate(const std::vector<Vec2>& q) {
        surfaces.update(packing.grains, q);
        force.assign(q.size(), Vec2::Zero());
        return friction.evaluate(surfaces, force);
    }
};

TEST(Friction, ForceIsTheDerivativeOfItsEnergyAndAtMostTheCoefficientTimesTheNormalForce) {
    Scene scene(0.1);
    scene.evaluate(scene.packing.q);
    const std::vector<Vec2> force = scene.force;
    int held = 0, sliding = 0;
    for (std::size_t p = 0; p < scene.friction.sliders().size(); ++p) {
        const Slider& s = scene.friction.sliders()[p];
        const PointContact& c = scene.contacts.points()[p];
        EXPECT_EQ(s.most, (c.j < 0 ? 0.3 : 0.5) * c.force());
        EXPECT_LE(std::abs(s.force()), s.most);
        if (s.most > 0.0) (std::abs(s.trial) <= s.most ? held : sliding) += 1;
    }
    EXPECT_GT(held, 10);
    EXPECT_GT(sliding, 10);
    for (int k = 0; k < 10; ++k) {
        const auto d = test::random_nodes(force.size(), 1.0, scene.random);
        const double step = 1e-7;
        const double slope = (scene.evaluate(test::sum(scene.packing.q, step, d)) -
                              scene.evaluate(test::sum(scene.packing.q, -step, d))) /
                             (2.0 * step);
        // Points that pass from held to sliding change their stiffness, not their force.
        EXPECT_NEAR(slope, test::dot(force, d), 1e-5 * test::norm(force) * test::norm(d));
    }
}

TEST(Friction, ActsOnBothGrainsAlikeAndOnWalls) {
    Scene scene(2e-4);
    scene.evaluate(scene.packing.q);
    Vec2 sum = Vec2::Zero();
    for (const Vec2& f : scene.force) sum += f;
    Vec2 walls = Vec2::Zero();
    for (const Vec2& f : scene.friction.wall_force()) walls += f;
    EXPECT_GT(walls.norm(), 1e-6);
    // The derivative on the nodes is minus the force on grains, which is that on walls.
    EXPECT_LT((sum - walls).norm(), 1e-13 * test::norm(scene.force));
}

TEST(Friction, DissipatesWhatItIsWorkedOnAndDoesNotStore) {
    Scene scene(2e-4);
    const double work = scene.evaluate(scene.packing.q);
    const double lost = scene.friction.end();
    EXPECT_GT(lost, 0.0);
    EXPECT_GT(scene.friction.stored(), 0.0);
    EXPECT_NEAR(lost + scene.friction.stored(), work, 1e-14 * work);
    // The springs go on where they were.
    const std::vector<Vec2> before = scene.force;
    scene.surfaces.update(scene.packing.grains, scene.packing.q);
    scene.friction.begin(scene.surfaces);
    scene.friction.lag(scene.contacts);
    EXPECT_EQ(scene.evaluate(scene.packing.q), 0.0);
    EXPECT_LT(test::norm(test::sum(before, -1.0, scene.force)), 1e-13 * test::norm(before));
    // Without contacts there is nothing left, and what was stored is lost.
    const double stored = scene.friction.stored();
    scene.packing.box = Box{{-9.0, 19.0, -9.0, 19.0}};
    for (std::size_t g = 0; g < scene.packing.grains.size(); ++g)
        for (Vec2& x : scene.packing.grains.of(scene.packing.q, g))
            x += static_cast<double>(g) * Vec2{5.0, 0.0};
    scene.evaluate_contacts();
    scene.friction.lag(scene.contacts);
    scene.evaluate(scene.packing.q);
    EXPECT_NEAR(scene.friction.end(), stored, 1e-14 * stored);
    EXPECT_EQ(scene.friction.stored(), 0.0);
}

/// Minimises the model alone with a spring to every node, as the equilibrium does with grains.
TEST(ModelSearch, EndsWhereTheModelHasItsLeastEnergy) {
    Scene scene(0.1);
    scene.evaluate(scene.packing.q);
    ContactModel model(scene.packing.grains);
    model.build(scene.contacts, scene.friction.sliders());
    const auto n = static_cast<Eigen::Index>(2 * scene.packing.q.size());
    const double spring = 500.0;  // stiffer than contacts that bend their points away
    const auto pull = test::random_nodes(scene.packing.q.size(), 0.05, scene.random);
    const auto energy = [&](const std::vector<Vec2>& d) {
        return model.energy(d) + 0.5 * spring * test::dot(d, d) - test::dot(pull, d);
    };
    std::vector<Touch> active;
    model.find_active({}, active);
    ModelSearch search(model);
    std::vector<Vec2> at(scene.packing.q.size(), Vec2::Zero()), to = at;
    std::vector<ContactStiffness> K;
    double last = 0.0;
    int looks = 0;
    for (bool seen = false; !seen && looks < 100; ++looks) {
        model.find_stiffness(active, K);
        Eigen::MatrixXd matrix = spring * Eigen::MatrixXd::Identity(n, n);
        for (const ContactStiffness& c : K)
            for (std::size_t a = 0; a < c.node.size(); ++a)
                for (std::size_t b = 0; b <= a; ++b)
                    matrix.block<2, 2>(2 * c.node[a], 2 * c.node[b]) += c.matrix.block<2, 2>(
                        static_cast<Eigen::Index>(2 * a), static_cast<Eigen::Index>(2 * b));
        std::vector<Vec2> b = pull;
        model.add_force(active, b);
        Eigen::Map<Eigen::VectorXd> right(b.front().data(), n);
        const Eigen::VectorXd x = matrix.selfadjointView<Eigen::Lower>().llt().solve(right);
        for (std::size_t m = 0; m < to.size(); ++m) to[m] = x.segment<2>(static_cast<Eigen::Index>(2 * m));
        const double share = search.approach(to, active);
        for (std::size_t m = 0; m < at.size(); ++m) at[m] += share * (to[m] - at[m]);
        const double now = energy(at);
        if (looks > 0) {
            EXPECT_LE(now, last + 1e-12 * std::abs(last));
        }
        last = now;
        seen = share == 1.0 && std::ranges::equal(search.touches(), active);
        active = search.touches();
    }
    EXPECT_GT(looks, 2);
    EXPECT_LT(looks, 100);
    for (int k = 0; k < 20; ++k) {
        const auto d = test::random_nodes(at.size(), 1e-6, scene.random);
        EXPECT_GT(energy(test::sum(at, 1.0, d)), last);
    }
}

}  // namespace
}  // namespace softgrain::mpm
