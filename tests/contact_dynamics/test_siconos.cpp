// Contact dynamics beside the non-smooth Gauss-Seidel of Siconos (Acary and Brogliato 2008) on the same
// problems.
//
// What can be compared: without friction the velocities are unique, and so are the impulses unless contacts
// are redundant. With friction neither needs to be unique; what holds for every answer is that it obeys the
// laws, and so each program's answer is judged by the other: by residuals() and by Siconos' natural map. In
// these clouds the active contacts are not redundant (test_direct_solution.cpp solves for their impulses),
// and both programs come to the same velocities and impulses, which is asserted too.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "contact_problem.hpp"
#include "siconos_input.hpp"

namespace softgrain {
namespace {

constexpr double h = SqueezedCloud::h;
constexpr double reach = 0.5;   // gaps that are looked at [m]
constexpr double noise = 1e-7;  // impulses / m_e above it are an active contact [m/s]

/// Friction inside groups and between them.
class Siconos : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(Siconos, AgreesOnHundredsOfContacts) {
    const auto [within, between] = GetParam();
    SqueezedCloud squeezed(3, 20, 20, 4);
    DiscCloud& cloud = squeezed.cloud;
    ContactDynamics contacts({.tolerance = 1e-14,
                              .skin = reach,
                              .max_iterations = 200000,
                              .within = {.friction = within},
                              .between = {.friction = between},
                              .block_discs = 30});
    for (int step = 0; step < 2; ++step) {
        SCOPED_TRACE(testing::Message() << "step " << step);
        if (step > 0) squeezed.advance();
        const ContactProblem problem = contact_problem(cloud, squeezed.walls, h, within, between, reach);
        SiconosInput input(problem);
        const SiconosProblem siconos = input.problem();
        Eigen::VectorXd theirs(2 * problem.size());
        int iterations = 0;
        EXPECT_EQ(siconos_solve(&siconos, 1e-12, 100000, theirs.data(), &iterations), 0);
        ASSERT_TRUE(contacts.solve(cloud.discs(), squeezed.walls, h).converged);
        const Eigen::VectorXd u = velocities_of(cloud);
        double unknown = 0.0;
        Eigen::VectorXd ours = impulses_of(contacts, problem, cloud, unknown);
        EXPECT_EQ(unknown, 0.0);

        const ContactResiduals found = residuals(problem, problem.velocities(theirs), theirs, noise);
        EXPECT_LT(found.largest(), 1e-10);
        EXPECT_GT(found.active, step == 0 ? 300 : 450);
        EXPECT_LT(residuals(problem, u, ours, noise).largest(), 1e-10);
        EXPECT_LT(siconos_error(&siconos, ours.data()), 1e-10);
        // Siconos stops at 1e-12; what is left of its error is some ten to a hundred times that.
        EXPECT_LT((u - problem.velocities(theirs)).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), 1e-8);
        if (within > 0.0) {
            EXPECT_GT(found.sticking, 30);
            EXPECT_GT(found.sliding, 100);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Coefficients, Siconos,
                         testing::Values(std::pair(0.0, 0.0), std::pair(0.0, 0.6), std::pair(0.1, 0.1),
                                         std::pair(0.3, 0.3), std::pair(0.1, 0.5), std::pair(0.6, 0.6)),
                         [](const auto& test) {
                             return "Within" + std::to_string(static_cast<int>(100 * test.param.first)) +
                                    "Between" + std::to_string(static_cast<int>(100 * test.param.second));
                         });

}  // namespace
}  // namespace softgrain
