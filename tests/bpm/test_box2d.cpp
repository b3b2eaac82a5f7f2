#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bpm/box2d_contacts.hpp"
#include "common/errors.hpp"
#include "sample.hpp"

namespace softgrain::bpm {
namespace {

// Single precision, at coordinates of up to 500 units: 1.5e-5 units of 0.01 diameters; velocities are rounded
// to 6e-8 of their size a few times.
constexpr double single_position = 1e-6;
constexpr double single_velocity = 1e-6;

/// Discs of diameter 1 in a box of 10, units 1.
struct FewDiscs {
    std::vector<Vec2> x, v;
    std::vector<double> mass;
    std::vector<int> group;
    std::vector<double> radius = std::vector<double>(x.size(), 0.5);
    std::vector<double> rim_speed = std::vector<double>(x.size(), 0.0);
    Box box{{0.0, 10.0, 0.0, 10.0}};

    Discs discs() { return {x, radius, mass, group, v, rim_speed}; }
};

TEST(Box2dContacts, AWallPushesADisc) {
    FewDiscs one{.x = {{0.5005, 5.0}}, .v = {{0.0, 0.0}}, .mass = {2.0}, .group = {0}};
    Box2dContacts contacts({}, one.discs(), one.box);
    const double h = 0.02;
    double impulse = 0.0;
    for (int k = 0; k < 100; ++k) {
        const WallMotion walls{one.box, {0.3, 0.0, 0.0, 0.0}};
        contacts.solve(one.discs(), walls, h, one.x);
        one.box = walls.after(h);
        const WallRows& rows = contacts.contacts().wall_rows;
        for (std::size_t r = 0; r < rows.size(); ++r) {
            EXPECT_EQ(rows.disc[r], 0);
            EXPECT_EQ(rows.wall[r], 0);
            impulse += one.mass[0] * rows.normal[r];
        }
    }
    EXPECT_NEAR(one.v[0].x(), 0.3, single_velocity);
    EXPECT_EQ(one.v[0].y(), 0.0);
    EXPECT_NEAR(impulse, 2.0 * 0.3, 2.0 * single_velocity);
    EXPECT_NEAR(one.x[0].y(), 5.0, single_position);
    // Box2D leaves its slop of 0.005 units; the skin of its polygons (0.01 units) must not show.
    EXPECT_NEAR(one.box.position[0] + 0.5 - one.x[0].x(), 5e-5, 2e-5);
}

TEST(Box2dContacts, EveryWallStopsADiscAtItsSurface) {
    for (int wall = 0; wall < 4; ++wall) {
        FewDiscs one{.x = {{5.0, 5.0}}, .v = {Vec2(-0.4 * wall_normal(wall))}, .mass = {1.0}, .group = {0}};
        Box2dContacts contacts({}, one.discs(), one.box);
        for (int k = 0; k < 700; ++k) contacts.solve(one.discs(), {one.box, {}}, 0.02, one.x);
        EXPECT_NEAR(one.v[0].norm(), 0.0, single_velocity) << wall;
        EXPECT_NEAR(one.box.distance(wall, one.x[0]), 0.5 - 5e-5, 2e-5) << wall;
    }
}

TEST(Box2dContacts, TwoDiscsMeetInelastically) {
    FewDiscs two{
        .x = {{4.5, 5.0}, {5.51, 5.0}}, .v = {{0.5, 0.1}, {-0.25, 0.1}}, .mass = {1.0, 3.0}, .group = {0, 1}};
    Box2dContacts contacts({}, two.discs(), two.box);
    contacts.solve(two.discs(), {two.box, {}}, 0.02, two.x);
    EXPECT_TRUE(contacts.contacts().rows.i.empty());  // not yet
    EXPECT_NEAR(two.x[0].x(), 4.51, single_position);
    contacts.solve(two.discs(), {two.box, {}}, 0.02, two.x);
    const SolvedContacts solved = contacts.contacts();
    ASSERT_EQ(solved.rows.i.size(), 1U);
    EXPECT_EQ(solved.rows.i[0], 0);
    EXPECT_EQ(solved.rows.j[0], 1);
    EXPECT_NEAR((solved.rows.direction[0] - Vec2::UnitX()).norm(), 0.0, single_position);
    // m_e = 3/4; the impulse over m_e is the closing speed; both go on with the velocity of their centre.
    EXPECT_NEAR(solved.reduced_mass(0, two.mass), 0.75, 1e-15);
    EXPECT_NEAR(solved.rows.normal[0], 0.75, single_velocity);
    EXPECT_NEAR(two.v[0].x(), (1.0 * 0.5 - 3.0 * 0.25) / 4.0, single_velocity);
    EXPECT_NEAR(two.v[1].x(), (1.0 * 0.5 - 3.0 * 0.25) / 4.0, single_velocity);
    EXPECT_NEAR(two.v[0].y(), 0.1, single_velocity);
    EXPECT_EQ(solved.rows.tangential[0], 0.0);
}

TEST(Box2dContacts, RubsBetweenGroupsOnly) {
    for (const bool same_group : {false, true})
        for (const double slip : {0.6, 6.0}) {
            FewDiscs two{.x = {{5.0, 4.50025}, {5.0, 5.49975}},
                         .v = {{0.0, 0.5}, {slip, 0.0}},
                         .mass = {1.0, 3.0},
                         .group = {2, same_group ? 2 : 0}};
            Box2dContacts contacts({.friction = 0.5}, two.discs(), two.box);
            contacts.solve(two.discs(), {two.box, {}}, 0.003, two.x);
            const SolvedContacts solved = contacts.contacts();
            ASSERT_EQ(solved.rows.i.size(), 1U);
            // Along n turned by +90 degrees, which is -x: the slip is -slip, and is stopped by a third of it
            // or as far as friction reaches.
            // Box2D's lever arm is shorter by half of the overlap of 5e-4.
            constexpr double shorter_arm = 5e-4;
            const double wanted = same_group ? 0.0 : std::min(slip / 3.0, 0.5 * 0.5);
            EXPECT_NEAR(solved.rows.normal[0], 0.5, single_velocity);
            EXPECT_NEAR(solved.rows.tangential[0], wanted, shorter_arm);
            const double impulse = 0.75 * wanted;
            EXPECT_NEAR(two.v[1].x(), slip - impulse / 3.0, shorter_arm);
            EXPECT_NEAR(two.v[0].x(), impulse, shorter_arm);
            // I = m r^2 / 2; both turn clockwise.
            EXPECT_NEAR(two.rim_speed[0], -2.0 * impulse, shorter_arm);
            EXPECT_NEAR(two.rim_speed[1], -2.0 * impulse / 3.0, shorter_arm);
        }
}

TEST(Box2dContacts, ListsWhatIsNearOnce) {
    FewDiscs three{.x = {{0.51, 5.0}, {1.51, 5.0}, {2.6, 5.0}},
                   .v = {{0.0, 0.0}, {-0.9, 0.0}, {0.0, 0.0}},
                   .mass = {1.0, 1.0, 1.0},
                   .group = {0, 0, 0}};
    three.x[1].x() = 1.5;  // overlaps the first by 0.01
    Box2dContacts contacts({}, three.discs(), three.box);
    contacts.solve(three.discs(), {three.box, {}}, 0.001, three.x);
    EXPECT_EQ(contacts.contacts().rows.i.size(), 1U);
    EXPECT_EQ(contacts.contacts().wall_rows.size(), 0U);
    for (int twice = 0; twice < 2; ++twice) {
        contacts.add_near(three.discs(), three.box, 0.12);
        const SolvedContacts all = contacts.contacts();
        ASSERT_EQ(all.rows.i.size(), 2U);
        EXPECT_GT(all.rows.normal[0], 0.0);
        EXPECT_EQ(all.rows.i[1], 1);
        EXPECT_EQ(all.rows.j[1], 2);
        EXPECT_EQ(all.rows.normal[1], 0.0);
        ASSERT_EQ(all.wall_rows.size(), 1U);
        EXPECT_EQ(all.wall_rows.disc[0], 0);
        EXPECT_EQ(all.wall_rows.wall[0], 0);
    }
}

TEST(Box2dContacts, RefusesABoxTooWideForSinglePrecision) {
    FewDiscs one{.x = {{5.0, 5.0}}, .v = {{0.0, 0.0}}, .mass = {1.0}, .group = {0}};
    one.box.position = {0.0, 700.0, 0.0, 10.0};
    EXPECT_THROW(Box2dContacts({}, one.discs(), one.box), InputError);
}

Scenario box2d_scenario(int discs, double friction = 0.0, std::uint64_t seed = 1) {
    Scenario scenario = scenario_of(discs, seed, friction);
    scenario.method_settings.at("bpm").set("engine", "box2d");
    return scenario;
}

/// Four grains pressed together by `steps` steps at 0.03.
struct Pressed {
    explicit Pressed(const Scenario& scenario, int steps = 300)
        : packing(square_packing(2, 2, 0.1)), solver(scenario, packing), box(packing.box) {
        const double h = solver.stable_time_step();
        for (int k = 0; k < steps; ++k) {
            const WallMotion walls = closing(box, 0.03);
            solver.advance(walls, h);
            box = walls.after(h);
            for (const Vec2& force : solver.wall_force()) impulse -= h * force;
            deepest = std::max(deepest, solver.penetration());
        }
    }
    Packing packing;
    BpmSolver solver;
    Box box;
    Vec2 impulse = Vec2::Zero();
    double deepest = 0.0;
};

TEST(Box2dEngine, StartsFromTheSamePositions) {
    const Packing packing = square_packing(2, 2, 0.1);
    const BpmSolver box2d(box2d_scenario(40), packing), nscd(scenario_of(40), packing);
    EXPECT_TRUE(std::ranges::equal(box2d.disc_position(), nscd.disc_position()));
    EXPECT_NEAR(nscd.stable_time_step() / box2d.stable_time_step(), 7.0, 1e-12);
}

TEST(Box2dEngine, GivesTheSameBitsTwice) {
    const Scenario scenario = box2d_scenario(40, 0.3);
    Pressed once(scenario, 1000), again(scenario, 1000);
    EXPECT_GT(once.deepest, 0.0);
    EXPECT_TRUE(std::ranges::equal(once.solver.disc_position(), again.solver.disc_position()));
    EXPECT_EQ(once.solver.wall_force(), again.solver.wall_force());
    EXPECT_EQ(once.solver.view(Need::base).energy.friction, again.solver.view(Need::base).energy.friction);
}

TEST(Box2dEngine, MomentumComesFromTheWallsAndEnergyIsAccountedFor) {
    for (const double friction : {0.0, 0.4}) {
        Pressed pressed(box2d_scenario(40, friction), 1500);
        const GrainView view = pressed.solver.view(Need::base);
        Vec2 momentum = Vec2::Zero();
        for (std::size_t g = 0; g < view.size(); ++g) momentum += view.mass[g] * view.velocity[g];
        // The walls gave 0.1 to each side.
        EXPECT_LT((momentum - pressed.impulse).norm(), 1e-5);
        const EnergyLedger& energy = view.energy;
        const double residual = energy.external_work - energy.kinetic - energy.elastic - energy.dissipated();
        EXPECT_GT(energy.external_work, 0.05);
        EXPECT_GT(energy.impact, 0.0);
        // As with the other engine: the error of integrating the attraction.
        EXPECT_LT(std::abs(residual), 5e-3 * energy.external_work) << "friction " << friction;
        EXPECT_EQ(energy.friction > 0.0, friction > 0.0);
    }
}

TEST(Box2dEngine, PenetrationFollowsTheStep) {
    std::vector<double> deepest;
    for (const double step : {0.04, 0.005}) {
        Scenario scenario = box2d_scenario(60);
        scenario.method_settings.at("bpm").set("step", step);
        deepest.push_back(Pressed(scenario, static_cast<int>(10.0 / step)).deepest);
    }
    EXPECT_GT(deepest[1], 5e-5);  // the slop
    EXPECT_LT(deepest[1], 5e-3);
    EXPECT_GT(deepest[0], 3.0 * deepest[1]);
}

/// Pairs of grains, and of grains and walls (-1 - wall), with a disc gap below `gap`: all pairs of discs
/// tried.
std::set<std::pair<int, int>> touching_grains(const GrainView& view, double gap) {
    std::set<std::pair<int, int>> found;
    const PartView& parts = view.parts;
    for (std::size_t d = 0; d < parts.size(); ++d) {
        for (int wall = 0; wall < 4; ++wall)
            if (view.box.distance(wall, parts.position[d]) < parts.radius[d] + gap)
                found.emplace(parts.grain[d], -1 - wall);
        for (std::size_t e = 0; e < parts.size(); ++e)
            if (parts.grain[d] < parts.grain[e] &&
                (parts.position[d] - parts.position[e]).norm() < parts.radius[d] + parts.radius[e] + gap)
                found.emplace(parts.grain[d], parts.grain[e]);
    }
    return found;
}

TEST(Box2dEngine, ShowsContactsLikeTheOtherEngine) {
    // Same placed grains, pressed for the same time: few rearrangements so far.
    Scenario box2d = box2d_scenario(40), nscd = scenario_of(40);
    box2d.method_settings.at("bpm").set("step", 0.01);
    Pressed a(box2d, 600), b(nscd, 86);
    const GrainView of_box2d = a.solver.view(Need::all | Need::parts);
    const GrainView of_nscd = b.solver.view(Need::all | Need::parts);
    const auto touching = [](const GrainView& view) {
        double sum = 0.0;
        for (double count : view.parts.fields[1].values) sum += count;
        return sum / static_cast<double>(view.parts.size());
    };
    EXPECT_NEAR(touching(of_box2d) / touching(of_nscd), 1.0, 0.05);
    EXPECT_GT(touching(of_nscd), 3.0);
    std::set<std::pair<int, int>> listed;
    for (const GrainContact& contact : of_box2d.contacts) listed.emplace(contact.i, contact.j);
    EXPECT_GE(listed.size(), 8U);  // at least the walls
    EXPECT_EQ(listed, touching_grains(of_box2d, 0.02 * a.solver.mean_disc_diameter()));
    // The contacts with the walls carry the wall forces.
    for (int wall = 0; wall < 4; ++wall) {
        Vec2 force = Vec2::Zero();
        for (const GrainContact& contact : of_box2d.contacts)
            if (contact.with_wall() && contact.wall() == wall) force -= contact.force;
        EXPECT_LT((force - of_box2d.wall_force[static_cast<std::size_t>(wall)]).norm(), 1e-12);
    }
}

TEST(Box2dEngine, TooFastAWallIsAnError) {
    const Packing packing = square_packing(1, 1, 0.1);
    BpmSolver solver(box2d_scenario(40), packing);
    Box box = packing.box;
    const auto rush = [&] {
        for (int k = 0; k < 40; ++k) {
            const WallMotion walls = closing(box, 2.0);
            solver.advance(walls, solver.stable_time_step());
            box = walls.after(solver.stable_time_step());
        }
    };
    EXPECT_THROW(rush(), DivergedError);
}

TEST(Box2dEngine, OverCompactionEndsTheRun) {
    const double side = std::sqrt(2.4);  // discs have an area of 2.7 = 0.86 pi
    int outside = 0, diverged = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Packing packing = square_packing(1, 1, 0.1);
        BpmSolver solver(box2d_scenario(40, 0.0, seed), packing);
        EXPECT_FALSE(solver.outside_validity().has_value());
        Box box = packing.box;
        try {
            while (box.width() > side && !solver.outside_validity()) {
                const WallMotion walls = closing(box, 0.05);
                solver.advance(walls, solver.stable_time_step());
                box = walls.after(solver.stable_time_step());
            }
            if (solver.outside_validity()) ++outside;
        } catch (const DivergedError&) {
            ++diverged;  // a disc was squeezed out too fast for Box2D
        }
    }
    EXPECT_EQ(outside + diverged, 4);
    EXPECT_GE(outside, 1);
}

TEST(Box2dEngine, RefusesToResume) {
    const Packing packing = square_packing(2, 1, 0.3);
    BpmSolver solver(box2d_scenario(20), packing), again(box2d_scenario(20), packing);
    Checkpoint checkpoint;
    solver.save(checkpoint);
    EXPECT_THROW(again.load(checkpoint), InputError);
}

TEST(Box2dEngine, RefusesWhatItDoesNotHave) {
    using Setting = std::pair<const char*, Value>;
    const auto refused = [](const char* engine, const std::vector<Setting>& settings) {
        Scenario scenario = scenario_of(20);
        scenario.method_settings.at("bpm").set("engine", engine);
        for (const auto& [key, value] : settings) scenario.method_settings.at("bpm").set(key, value);
        try {
            settings_of(scenario);
        } catch (const InputError& error) {
            const std::string text = error.what();
            EXPECT_NE(text.find("box2d"), std::string::npos) << text;
            EXPECT_NE(text.find("leave it out"), std::string::npos) << text;
            return true;
        }
        return false;
    };
    const std::vector<std::vector<Setting>> not_with_box2d{{{"grain", "elastic"}},
                                                           {{"grain", "brittle"}, {"bond_strength", 1.0}},
                                                           {{"rolling_resistance", 0.1}},
                                                           {{"friction_within", 0.1}}};
    for (const auto& settings : not_with_box2d) {
        EXPECT_TRUE(refused("box2d", settings)) << settings[0].first;
        EXPECT_FALSE(refused("nscd", settings)) << settings[0].first;
    }
    for (const char* key : {"box2d_velocity_iterations", "box2d_position_iterations"}) {
        EXPECT_FALSE(refused("box2d", {{key, std::int64_t{4}}}));
        EXPECT_TRUE(refused("nscd", {{key, std::int64_t{4}}}));
    }
}

}  // namespace
}  // namespace softgrain::bpm
