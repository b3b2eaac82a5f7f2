// Modulus and Poisson ratio of a grain held by elastic bonds, from two tests that load it differently.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "bpm/grain_compression.hpp"
#include "common/observables/affine_fit.hpp"
#include "sample.hpp"

namespace softgrain::bpm {
namespace {

enum class Loading { diametral, oedometric };

/// Of a sheet (plane stress); modulus in units of the bond stiffness.
struct Elasticity {
    double modulus, poisson_ratio, turned;
};

/// Strain of the middle of a disc under point loads P on the vertical and Q on the horizontal diameter
/// against the stress there, (2 Q - 6 P)/(pi D) and (2 P - 6 Q)/(pi D) (Hertz 1895, the Brazilian test). In
/// the oedometric test side walls stay where they touched the grain.
Elasticity elasticity_of(std::uint64_t seed, Loading loading) {
    constexpr double strain = 0.02, speed = 1e-3, core = 0.4;  // of the radius
    constexpr int resting_steps = 6000;
    Scenario scenario = bonded_scenario_of(400);
    scenario.seed = seed;
    const Packing packing = square_packing(1, 1, 1.0);
    BpmSolver solver(scenario, packing);
    const Extent width = extent_of_discs(solver, 0), height = extent_of_discs(solver, 1);
    Box box = packing.box;
    if (loading == Loading::oedometric) {
        box.position[0] = width.low;
        box.position[1] = width.high;
    }
    box.position[2] = height.low;
    box.position[3] = height.high;
    const Vec2 middle{0.5 * (width.low + width.high), 0.5 * (height.low + height.high)};
    std::vector<std::size_t> inner;
    for (std::size_t d = 0; d < solver.disc_position().size(); ++d)
        if ((solver.disc_position()[d] - middle).norm() < core * 0.5 * height.length()) inner.push_back(d);
    const auto positions = [&] {
        std::vector<Vec2> x;
        for (const std::size_t d : inner) x.push_back(solver.disc_position()[d]);
        return x;
    };
    const std::vector<Vec2> before = positions();
    const double h = solver.stable_time_step();
    while (box.height() > (1.0 - strain) * height.length()) {
        const WallMotion walls{box, {0.0, 0.0, 0.5 * speed, -0.5 * speed}};
        solver.advance(walls, h);
        box = walls.after(h);
    }
    for (int k = 0; k < resting_steps; ++k) solver.advance({box, {}}, h);

    const Mat2 F = fit_affine(before, positions()).gradient;
    const double angle = std::atan2(F(1, 0) - F(0, 1), F(0, 0) + F(1, 1));
    const Mat2 stretch = F * Eigen::Rotation2D<double>(-angle).toRotationMatrix();
    const double ex = stretch(0, 0) - 1.0, ey = stretch(1, 1) - 1.0;
    const auto& force = solver.wall_force();
    const double P = 0.5 * (force[3].y() - force[2].y()), Q = 0.5 * (force[1].x() - force[0].x());
    const double scale = 1.0 / (std::numbers::pi * height.length());
    const double sx = scale * (2.0 * P - 6.0 * Q), sy = scale * (2.0 * Q - 6.0 * P);
    // ex = sx/E - sy nu/E, ey = sy/E - sx nu/E.
    const double determinant = sy * sy - sx * sx;
    const double compliance = (sy * ey - sx * ex) / determinant, cross = (sx * ey - sy * ex) / determinant;
    return {1.0 / compliance, cross / compliance, std::abs(angle)};
}

TEST(ElasticGrain, BothTestsGiveOneModulusAndOnePoissonRatio) {
    for (const Loading loading : {Loading::diametral, Loading::oedometric}) {
        double modulus = 0.0, ratio = 0.0;
        int grains = 0;
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const Elasticity grain = elasticity_of(seed, loading);
            if (grain.turned > 0.1) continue;  // rolled onto a flat side: no longer loaded along a diameter
            modulus += grain.modulus;
            ratio += grain.poisson_ratio;
            ++grains;
        }
        // Of 40 seeds 12 and 20 do not roll, with steps of half the stable one 12 and 18.
        ASSERT_GE(grains, 3);
        // Springs on a triangular lattice: 2/sqrt(3) = 1.15 k for nearest neighbours, and 1/3. Our bonds
        // reach a little further. Measured, single grains: 1.35 to 1.48 and 0.26 to 0.35.
        EXPECT_NEAR(modulus / grains, 1.40, 0.10);
        EXPECT_NEAR(ratio / grains, 0.31, 0.05);
    }
}

}  // namespace
}  // namespace softgrain::bpm
