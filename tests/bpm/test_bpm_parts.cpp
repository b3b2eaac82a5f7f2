// The discs as parts of the view, and their motion.
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>

#include "sample.hpp"

namespace softgrain::bpm {
namespace {

TEST(BpmParts, PartsAreTheDiscs) {
    BpmSolver solver(scenario_of(30), square_packing(2, 1, 0.1));
    const std::vector<Vec2> start(solver.disc_position().begin(), solver.disc_position().end());
    Box box = solver.view(Need::base).box;
    for (int k = 0; k < 20; ++k) {
        const WallMotion walls = closing(box, 0.1);
        solver.advance(walls, solver.stable_time_step());
        box = walls.after(solver.stable_time_step());
    }
    const GrainView view = solver.view(Need::parts);
    const PartView& parts = view.parts;
    ASSERT_EQ(parts.size(), 60U);
    EXPECT_TRUE(std::ranges::equal(parts.position, solver.disc_position()));
    EXPECT_TRUE(std::ranges::equal(parts.radius, solver.disc_radius()));
    EXPECT_TRUE(std::ranges::equal(parts.reference, start));
    double moved = 0.0;
    for (std::size_t d = 0; d < 60; ++d) {
        EXPECT_EQ(parts.grain[d], d < 30 ? 0 : 1);
        moved = std::max(moved, (parts.position[d] - parts.reference[d]).norm());
    }
    EXPECT_GT(moved, 0.0);
    EXPECT_EQ(parts.fields[0].name, "velocity");
    Vec2 mean = Vec2::Zero();  // by mass, which is as the disc's area
    double weight = 0.0;
    for (std::size_t d = 0; d < 30; ++d) {
        const double area = parts.radius[d] * parts.radius[d];
        mean += area * Vec2(parts.fields[0].values[2 * d], parts.fields[0].values[2 * d + 1]);
        weight += area;
    }
    EXPECT_LT((mean / weight - view.velocity[0]).norm(), 1e-12 * view.velocity[0].norm());
}

std::span<const double> values_of(const std::vector<Field>& fields, std::string_view name) {
    for (const Field& field : fields)
        if (field.name == name) return field.values;
    throw std::runtime_error("no field " + std::string(name));
}

/// Discs at rest, then moved by hand by way of a checkpoint, as no loading could.
TEST(BpmParts, NonAffineMotionIsWhatIsBeyondAnAffineOne) {
    const Packing packing = square_packing(2, 1, 0.5);
    BpmSolver solver(scenario_of(40), packing);
    const double d = solver.mean_disc_diameter();
    EXPECT_EQ(values_of(solver.view(Need::fields).fields, "non_affine_motion")[0], 0.0);
    Mat2 gradient;
    gradient << 1.2, 0.3, -0.2, 0.8;
    Checkpoint state;
    solver.save(state);
    std::vector<Vec2> x;
    state.get("bpm.x", x);
    for (std::size_t k = 0; k < 40; ++k) x[k] = gradient * x[k] + Vec2(3.0, -4.0);
    x[50].y() += 2.0 * d;  // one of the 40 discs of the second grain
    state.put("bpm.x", std::span<const Vec2>(x));
    solver.load(state);
    const GrainView view = solver.view(Need::fields | Need::parts);
    const auto motion = values_of(view.fields, "non_affine_motion");
    const auto of_disc = values_of(view.parts.fields, "non_affine_displacement");
    const auto deformation = values_of(view.fields, "F");
    for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(deformation[static_cast<std::size_t>(k)], gradient(k / 2, k % 2), 1e-13);
    EXPECT_LT(motion[0], 1e-24);
    for (std::size_t k = 0; k < 80; ++k) EXPECT_LT(std::abs(of_disc[k]), 1e-12);
    // The grain's affine motion takes up 1/n + a.M^-1 a of one disc's motion, a its arm, M = sum a a^T.
    Vec2 middle = Vec2::Zero();
    for (std::size_t k = 40; k < 80; ++k) middle += view.parts.reference[k] / 40.0;
    Mat2 moment = Mat2::Zero();
    for (std::size_t k = 40; k < 80; ++k) {
        const Vec2 arm = view.parts.reference[k] - middle;
        moment += arm * arm.transpose();
    }
    const Vec2 arm = view.parts.reference[50] - middle;
    const double left = 1.0 - 1.0 / 40.0 - arm.dot(moment.inverse() * arm);
    EXPECT_NEAR(motion[1], 4.0 * left / 40.0, 1e-12);
    EXPECT_NEAR(of_disc[2 * 50 + 1], 2.0 * d * left, 1e-12);
    EXPECT_NEAR(of_disc[2 * 50], 0.0, 1e-12);
}

TEST(BpmParts, TouchingDiscsAreCountedOneByOne) {
    Pressed sample;
    const PartView parts = sample.solver.view(Need::parts).parts;
    const double gap = 0.02 * sample.solver.mean_disc_diameter();
    ASSERT_EQ(parts.fields[1].name, "touching");
    for (std::size_t i = 0; i < parts.size(); ++i) {
        int count = 0;
        for (std::size_t j = 0; j < parts.size(); ++j)
            count += i != j &&
                     (parts.position[j] - parts.position[i]).norm() < parts.radius[i] + parts.radius[j] + gap;
        for (int wall = 0; wall < 4; ++wall)
            count += sample.box.distance(wall, parts.position[i]) < parts.radius[i] + gap;
        EXPECT_EQ(parts.fields[1].values[i], count) << i;
    }
}

/// Contacts of discs add up to those of their grains, to the force on the walls and to that on each disc.
TEST(BpmParts, DiscContactsAddUp) {
    Pressed sample(0.3);
    const GrainView view = sample.solver.view(Need::parts | Need::contacts);
    const PartView& parts = view.parts;
    std::map<std::pair<int, int>, Vec2> on_grain;  // force on the first one
    std::vector<double> on_disc(parts.size(), 0.0);
    int within = 0;
    for (std::size_t k = 0; k < parts.contacts.size(); ++k) {
        const PartContact& c = parts.contacts[k];
        EXPECT_GT(c.normal_force, 0.0);
        if (k > 0) {
            EXPECT_LT(std::pair(parts.contacts[k - 1].i, parts.contacts[k - 1].j), std::pair(c.i, c.j));
        }
        const auto i = static_cast<std::size_t>(c.i);
        on_disc[i] += c.normal_force;
        Vec2 normal = c.with_wall() ? Vec2(-wall_normal(c.wall())) : Vec2::Zero();
        int other = c.j;
        if (!c.with_wall()) {
            const auto j = static_cast<std::size_t>(c.j);
            ASSERT_GT(c.j, c.i);
            on_disc[j] += c.normal_force;
            normal = (parts.position[j] - parts.position[i]).normalized();
            other = parts.grain[j];
        }
        if (other == parts.grain[i]) {
            EXPECT_EQ(c.tangential_force, 0.0) << "no friction within a grain";
            ++within;
            continue;
        }
        const Vec2 force = -c.normal_force * normal + c.tangential_force * perpendicular(normal);
        const auto [place, fresh] = on_grain.try_emplace({parts.grain[i], other}, Vec2::Zero());
        place->second += force;
    }
    EXPECT_GT(within, 100);
    EXPECT_EQ(parts.fields[2].name, "contact_force");
    for (std::size_t d = 0; d < parts.size(); ++d) EXPECT_NEAR(parts.fields[2].values[d], on_disc[d], 1e-12);
    int loaded = 0;
    for (const GrainContact& c : view.contacts) {
        if (c.force.norm() == 0.0) continue;
        ++loaded;
        ASSERT_TRUE(on_grain.contains({c.i, c.j}));
        // Directions have turned by the last step's motion: 1e-4 diameters at rest.
        EXPECT_LT((on_grain[{c.i, c.j}] - c.force).norm(), 1e-3 * c.force.norm());
    }
    EXPECT_EQ(loaded, static_cast<int>(on_grain.size()));
}

}  // namespace
}  // namespace softgrain::bpm
