// Packings that a file may not hold, from a program that calls the methods: no result is not finite.
#include <gtest/gtest.h>

#include <cmath>

#include "common/errors.hpp"
#include "tests/contract/scenes.hpp"

namespace softgrain {
namespace {

using namespace testing;

class HardPackings : public ::testing::TestWithParam<Bands> {
  protected:
    /// Lets the grains go. They end with finite values, or with a reason.
    void let_go(const Packing& packing) const {
        try {
            const auto solver = make(GetParam(), scenario_of(GetParam().method), packing);
            for (int k = 0; k < 200; ++k)
                solver->advance(WallMotion{packing.box, {}, 0.0}, solver->stable_time_step());
            solver->check_finite();
            const GrainView view = solver->view(Need::contacts | Need::area);
            for (const Vec2& x : view.centroid) EXPECT_TRUE(x.allFinite());
            for (const GrainContact& c : view.contacts) EXPECT_TRUE(c.force.allFinite());
            EXPECT_TRUE(std::isfinite(view.energy.kinetic) && std::isfinite(view.energy.elastic));
        } catch (const InputError& error) {
            EXPECT_GT(std::string(error.what()).size(), 20U);
        } catch (const DivergedError& error) {
            EXPECT_GT(std::string(error.what()).size(), 20U);
        }
    }
    /// Two grains on a line in the middle of a wide box.
    static Packing pair(double distance, double radius) {
        Packing p;
        p.box.position = {0.0, 12.0, 0.0, 12.0};
        p.center = {{6.0, 6.0}, {6.0 + distance, 6.0}};
        p.radius = {1.0, radius};
        return p;
    }
};

INSTANTIATE_TEST_SUITE_P(Methods, HardPackings, ::testing::ValuesIn(all_bands()),
                         [](const auto& instance) { return instance.param.method; });

TEST_P(HardPackings, OverlapOfABillionthOfARadius) {
    let_go(pair(2.0 - 1e-9, 1.0));
}
TEST_P(HardPackings, OverlapOfARadius) {
    let_go(pair(1.0, 1.0));
}
TEST_P(HardPackings, NearlyCoincident) {
    let_go(pair(1e-9, 1.0));
}
TEST_P(HardPackings, Coincident) {
    let_go(pair(0.0, 1.0));
}
TEST_P(HardPackings, OneInsideTheOther) {
    let_go(pair(0.1, 0.2));
}
TEST_P(HardPackings, BeyondAWall) {
    Packing p = pair(4.0, 1.0);
    p.center[0].x() = -1.0;
    let_go(p);
}

}  // namespace
}  // namespace softgrain
