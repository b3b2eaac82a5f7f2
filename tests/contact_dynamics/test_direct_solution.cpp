// Whole steps of contact dynamics against direct solutions, which share no code with it, and against the
// laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "contact_problem.hpp"
#include "dense_oracle.hpp"

namespace softgrain {
namespace {

constexpr double h = SqueezedCloud::h;
constexpr double reach = 0.5;   // gaps that are looked at [m]; nothing moves by half of it in a step
constexpr double noise = 1e-9;  // impulses / m_e above it are not rounding [m/s]
constexpr double band = 1e-10;  // velocities; the solver stops at changes of 1e-13, about 1e3 below

ContactSettings exact(contact_sweep::Resistance within, contact_sweep::Resistance between) {
    return {.tolerance = 1e-14,
            .skin = reach,
            .max_iterations = 200000,
            .within = within,
            .between = between,
            .block_discs = 30};
}

void expect_laws(const ContactResiduals& found) {
    EXPECT_LT(found.overlap, band);
    EXPECT_LT(found.pull, band);
    EXPECT_LT(found.complementarity, band);
    EXPECT_LT(found.cone, band);
    EXPECT_LT(found.stick, band);
    EXPECT_LT(found.wrong_way, band);
    EXPECT_LT(found.momentum, band);
}

/// Contacts with an impulse: between blocks, and at walls.
std::pair<int, int> active_seams_and_walls(const ContactDynamics& contacts) {
    const ContactRows& rows = contacts.rows();
    const auto above = [](double impulse) { return impulse > noise; };
    return {static_cast<int>(
                std::count_if(rows.normal.begin() + rows.block_start.back(), rows.normal.end(), above)),
            static_cast<int>(std::count_if(contacts.wall_rows().normal.begin(),
                                           contacts.wall_rows().normal.end(), above))};
}

TEST(DirectSolution, OfSmallCloudsWithoutFriction) {
    for (unsigned seed = 0; seed < 5; ++seed) {
        DiscCloud cloud = disc_cloud(seed, 6, 5, seed % 3 == 0 ? 1 : 3);
        // Walls that touch the outer discs and close in.
        const WallMotion walls{{{-0.48, 6.05, -0.48, 4.05}}, {0.2, -0.3, 0.1, 0.0}};
        const ContactProblem problem = contact_problem(cloud, walls, h, 0.0, 0.0, 1.0);
        const Eigen::VectorXd r = direct_frictionless_impulses(problem);
        expect_laws(residuals(problem, problem.velocities(r), r, noise));
        ContactDynamics contacts(exact({}, {}));
        ASSERT_TRUE(contacts.solve(cloud.discs(), walls, h).converged);
        const Eigen::VectorXd u = velocities_of(cloud);
        EXPECT_LT((u - problem.velocities(r)).cwiseAbs().maxCoeff(), band) << "seed " << seed;
        EXPECT_GT((u - problem.u_free).cwiseAbs().maxCoeff(), 0.1);  // there was something to solve
    }
}

TEST(DirectSolution, OfHundredsOfContactsWithoutFriction) {
    for (unsigned seed = 0; seed < 3; ++seed) {
        SqueezedCloud squeezed(seed, 20, 20, seed == 0 ? 1 : 4);
        DiscCloud& cloud = squeezed.cloud;
        ContactDynamics contacts(exact({}, {}));
        for (int step = 0; step < 2; ++step) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << " step " << step);
            if (step > 0) squeezed.advance();
            const ContactProblem problem = contact_problem(cloud, squeezed.walls, h, 0.0, 0.0, reach);
            const Eigen::VectorXd r = direct_frictionless_impulses(problem);
            const ContactResiduals direct = residuals(problem, problem.velocities(r), r, noise);
            expect_laws(direct);
            EXPECT_GT(direct.active, step == 0 ? 300 : 450);

            ASSERT_TRUE(contacts.solve(cloud.discs(), squeezed.walls, h).converged);
            const Eigen::VectorXd u = velocities_of(cloud);
            EXPECT_LT((u - problem.velocities(r)).cwiseAbs().maxCoeff(), band);
            EXPECT_LT(h * u.cwiseAbs().maxCoeff(), 0.5 * reach);
            // No contact is redundant here, so the impulses are unique too.
            double unknown = 0.0;
            const Eigen::VectorXd found = impulses_of(contacts, problem, cloud, unknown);
            EXPECT_LT((found - r).cwiseAbs().maxCoeff(), 1e-9);
            EXPECT_EQ(unknown, 0.0);
            const auto [seams, walls] = active_seams_and_walls(contacts);
            EXPECT_GT(seams, 50);
            EXPECT_GT(walls, 10);
        }
    }
}

/// Friction inside groups and between them.
class DirectSolutionWithFriction : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(DirectSolutionWithFriction, OfHundredsOfContacts) {
    const auto [within, between] = GetParam();
    SqueezedCloud squeezed(3, 20, 20, 4);
    DiscCloud& cloud = squeezed.cloud;
    ContactDynamics contacts(exact({.friction = within}, {.friction = between}));
    for (int step = 0; step < 2; ++step) {
        SCOPED_TRACE(testing::Message() << "step " << step);
        if (step > 0) squeezed.advance();
        const ContactProblem problem = contact_problem(cloud, squeezed.walls, h, within, between, reach);
        ASSERT_TRUE(contacts.solve(cloud.discs(), squeezed.walls, h).converged);
        const Eigen::VectorXd u = velocities_of(cloud);
        double unknown = 0.0;
        const Eigen::VectorXd r = impulses_of(contacts, problem, cloud, unknown);
        EXPECT_EQ(unknown, 0.0);
        EXPECT_LT(h * u.cwiseAbs().maxCoeff(), 0.5 * reach);
        const ContactResiduals found = residuals(problem, u, r, noise);
        expect_laws(found);
        EXPECT_GT(found.active, step == 0 ? 300 : 450);
        if (within > 0.0) {
            EXPECT_GT(found.sticking, 30);
            EXPECT_GT(found.sliding, 100);
        }

        // Which contacts slide is taken from the solver; the laws then say whether that was right.
        const Eigen::VectorXd direct = direct_frictional_impulses(problem, r, noise);
        expect_laws(residuals(problem, problem.velocities(direct), direct, noise));
        EXPECT_LT((u - problem.velocities(direct)).cwiseAbs().maxCoeff(), band);
        const auto [seams, walls] = active_seams_and_walls(contacts);
        EXPECT_GT(seams, 50);
        EXPECT_GT(walls, 10);
    }
}

INSTANTIATE_TEST_SUITE_P(Coefficients, DirectSolutionWithFriction,
                         testing::Values(std::pair(0.0, 0.6), std::pair(0.3, 0.3), std::pair(0.1, 0.5),
                                         std::pair(0.6, 0.6)),
                         [](const auto& test) {
                             return "Within" + std::to_string(static_cast<int>(100 * test.param.first)) +
                                    "Between" + std::to_string(static_cast<int>(100 * test.param.second));
                         });

}  // namespace
}  // namespace softgrain
