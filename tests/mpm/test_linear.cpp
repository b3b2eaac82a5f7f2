// Linear solvers against each other and against a dense matrix; the order of elimination.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "discs.hpp"
#include "mpm/contact/contact_model.hpp"
#include "mpm/grain_forces.hpp"
#include "mpm/linear/elimination.hpp"
#include "mpm/linear/front_solver.hpp"
#include "mpm/linear/sparse_solver.hpp"

namespace softgrain::mpm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A packing with its stiffness.
struct Problem {
    test::Packing packing;
    Contacts contacts;
    ContactModel model;
    std::vector<Touch> active;
    Stiffness K;

    Problem(int cells, int rows, int columns, unsigned seed)
        : packing(cells, rows, columns, 1e-4, seed), contacts(packing.grains, 100.0), model(packing.grains) {
        const Grains& grains = packing.grains;
        GrainForces forces(*grains.disc, *grains.pattern, true);
        const std::size_t places = grains.pattern->size();
        K.grain.resize(grains.size() * places);
        std::vector<Vec2> unused(grains.nodes());
        for (std::size_t g = 0; g < grains.size(); ++g)
            forces.evaluate(grains.grain[g], std::as_const(grains).of(packing.q, g), {}, unused,
                            {K.grain.data() + g * places, places});
        K.shift = 1e-3;
        touch(packing.box);
    }
    /// Contacts in this box. Overlaps are small, so that K is positive definite, but all points that are near
    /// count.
    void touch(const Box& box) {
        Surfaces surfaces;
        surfaces.update(packing.grains, packing.q);
        std::vector<Vec2> unused(packing.q.size());
        contacts.evaluate(surfaces, box, unused);
        model.build(contacts);
        active.assign(model.points(), Touch{true});
        model.find_stiffness(active, K.contact);
    }
    const Grains& grains() const { return packing.grains; }
    std::vector<Vec2> load(unsigned seed = 1) const {
        std::mt19937_64 random(seed);
        return test::random_nodes(packing.q.size(), 1.0, random);
    }
};

Box far_away() {
    return Box{{-100.0, 100.0, -100.0, 100.0}};
}

/// The whole matrix, both triangles.
MatrixXd dense(const Grains& grains, const Stiffness& K) {
    const auto size = static_cast<Eigen::Index>(2 * grains.all_nodes());
    MatrixXd A = K.shift * MatrixXd::Identity(size, size);
    const auto add = [&](std::size_t m, std::size_t n, const Mat2& block) {
        const auto row = static_cast<Eigen::Index>(2 * m), column = static_cast<Eigen::Index>(2 * n);
        A.block<2, 2>(row, column) += block;
        if (m != n) A.block<2, 2>(column, row) += block.transpose();
    };
    const StiffnessPattern& pattern = *grains.pattern;
    for (std::size_t g = 0; g < grains.size(); ++g)
        for (std::size_t m = 0; m < grains.nodes(); ++m)
            for (int k = pattern.start[m]; k < pattern.start[m + 1]; ++k)
                add(g * grains.nodes() + m,
                    g * grains.nodes() +
                        static_cast<std::size_t>(pattern.column[static_cast<std::size_t>(k)]),
                    K.grain[g * pattern.size() + static_cast<std::size_t>(k)]);
    std::set<int> touched;
    for (const ContactStiffness& c : K.contact) {
        MatrixXd whole = c.matrix.selfadjointView<Eigen::Lower>();
        for (std::size_t a = 0; a < c.node.size(); ++a) {
            touched.insert(c.node[a]);
            for (std::size_t b = 0; b < c.node.size(); ++b)
                A.block<2, 2>(2 * c.node[a], 2 * c.node[b]) +=
                    whole.block<2, 2>(static_cast<Eigen::Index>(2 * a), static_cast<Eigen::Index>(2 * b));
        }
    }
    for (const int m : touched) A.diagonal().segment<2>(2 * m).array() += K.contact_shift;
    return A;
}

std::vector<Vec2> solve(LinearSolver& solver, const std::vector<Vec2>& b) {
    std::vector<Vec2> x(b.size());
    solver.begin(b);
    solver.solve_contacts(std::vector<Vec2>(b.size(), Vec2::Zero()), x);
    solver.finish(x);
    return x;
}
/// Empty if K is not positive definite.
std::vector<Vec2> solution(LinearSolver& solver, const Stiffness& K, const std::vector<Vec2>& b) {
    if (!solver.factor_grains(K) || !solver.factor_contacts(K)) return {};
    return solve(solver, b);
}
std::vector<Vec2> dense_solution(const Grains& grains, const Stiffness& K, const std::vector<Vec2>& b) {
    const Eigen::LLT<MatrixXd> cholesky(dense(grains, K));
    if (cholesky.info() != Eigen::Success) return {};
    std::vector<Vec2> x = b;
    Eigen::Map<VectorXd> flat(x.front().data(), static_cast<Eigen::Index>(2 * x.size()));
    flat = cholesky.solve(flat).eval();
    return x;
}

/// Largest difference relative to the size of x: rounding times a condition of 10^5. Contacts are a hundred
/// times stiffer than grains, and those a thousand times stiffer than the shift.
constexpr double same = 1e-10;
double difference(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    if (a.size() != b.size() || a.empty()) return 1.0;
    return test::norm(test::sum(a, -1.0, b)) / test::norm(b);
}
void expect_right(LinearSolver& solver, const Grains& grains, const Stiffness& K,
                  const std::vector<Vec2>& b) {
    const std::vector<Vec2> right = dense_solution(grains, K, b);
    ASSERT_FALSE(right.empty());
    EXPECT_LT(difference(solution(solver, K, b), right), same);
}

TEST(LinearSolvers, AgreeWithTheDenseMatrix) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        Problem problem(3, 2, 2, seed);
        ASSERT_GE(problem.K.contact.size(), 10U);
        problem.K.contact_shift = seed == 1 ? 0.0 : 0.3;
        FrontSolver front(problem.grains());
        SparseSolver sparse(problem.grains());
        const auto b = problem.load();
        expect_right(front, problem.grains(), problem.K, b);
        expect_right(sparse, problem.grains(), problem.K, b);
        // Another right side with the same factors.
        EXPECT_LT(difference(solve(front, problem.load(2)),
                             dense_solution(problem.grains(), problem.K, problem.load(2))),
                  same);
    }
}

TEST(LinearSolvers, AgreeWithEachOther) {
    for (const int cells : {2, 4, 5, 8}) {
        Problem problem(cells, 3, 3, static_cast<unsigned>(cells));
        problem.K.contact_shift = 1e-2;
        FrontSolver front(problem.grains());
        SparseSolver sparse(problem.grains());
        const auto b = problem.load();
        const auto x = solution(sparse, problem.K, b);
        ASSERT_FALSE(x.empty());
        EXPECT_LT(difference(solution(front, problem.K, b), x), same) << cells;
        EXPECT_GT(front.operations(), 0.0);
    }
}

TEST(LinearSolvers, ShiftsAreOnTheDiagonalOnceANode) {
    // Every node of a contact is in two groups.
    Problem problem(3, 1, 2, 4);
    const auto groups = problem.K.contact;
    problem.K.contact.insert(problem.K.contact.end(), groups.begin(), groups.end());
    const auto b = problem.load();
    std::vector<std::vector<Vec2>> x;
    for (const auto& [shift, contact_shift] :
         {std::pair{1e-3, 0.0}, std::pair{0.2, 0.0}, std::pair{1e-3, 0.5}, std::pair{0.2, 0.5}}) {
        problem.K.shift = shift;
        problem.K.contact_shift = contact_shift;
        FrontSolver front(problem.grains());
        SparseSolver sparse(problem.grains());
        expect_right(front, problem.grains(), problem.K, b);
        expect_right(sparse, problem.grains(), problem.K, b);
        x.push_back(solution(front, problem.K, b));
    }
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_GT(difference(x[i], x[j]), 1e-3);
}

TEST(LinearSolvers, ContactsMayChangeForTheSameGrains) {
    Problem problem(4, 2, 3, 5);
    const Grains& grains = problem.grains();
    FrontSolver front(grains);
    SparseSolver sparse(grains);
    for (LinearSolver* solver : {static_cast<LinearSolver*>(&front), static_cast<LinearSolver*>(&sparse)}) {
        // As in a step of Newton's method: grains and their loads once, contacts again and again.
        const std::vector<Vec2> b = problem.load();
        problem.K.contact_shift = 0.0;
        ASSERT_TRUE(solver->factor_grains(problem.K));
        ASSERT_TRUE(solver->factor_contacts(problem.K));
        solver->begin(b);
        std::mt19937_64 random(5);
        std::vector<Vec2> last, x(b.size());
        for (int k = 0; k < 4; ++k) {
            for (Touch& a : problem.active) a.presses = random() % 2 != 0;
            problem.model.find_stiffness(problem.active, problem.K.contact);
            problem.K.contact_shift = 0.5 * k + 0.5;
            ASSERT_TRUE(solver->factor_contacts(problem.K));
            std::vector<Vec2> c(b.size(), Vec2::Zero());
            std::vector<char> touched(b.size(), 0);
            for (const ContactStiffness& group : problem.K.contact)
                for (const int m : group.node) {
                    c[static_cast<std::size_t>(m)] = test::random_vector(random, 1.0);
                    touched[static_cast<std::size_t>(m)] = 1;
                }
            SparseSolver fresh(grains);
            const auto right = solution(fresh, problem.K, test::sum(b, 1.0, c));
            ASSERT_FALSE(right.empty());
            solver->solve_contacts(c, x);
            for (std::size_t m = 0; m < x.size(); ++m)
                if (touched[m]) {
                    EXPECT_LT((x[m] - right[m]).norm(), same * test::norm(right));
                }
            if (k % 2) continue;  // not each is finished
            solver->finish(x);
            EXPECT_LT(difference(x, right), same);
            EXPECT_GT(difference(x, last), 1e-3);
            last = x;
        }
    }
}

TEST(FrontSolver, ContactsMayBeOthers) {
    Problem problem(4, 2, 3, 6);
    FrontSolver used(problem.grains());
    const auto b = problem.load();
    Box box = problem.packing.box;
    for (int k = 0; k < 4; ++k) {
        if (k == 1) box.position[0] -= 1.0;
        if (k == 2) box = far_away();
        if (k == 3) box = problem.packing.box;
        problem.touch(box);
        FrontSolver fresh(problem.grains());
        const auto x = solution(used, problem.K, b), expected = solution(fresh, problem.K, b);
        EXPECT_EQ(x, expected);  // a plan kept does not show
        SparseSolver sparse(problem.grains());
        EXPECT_LT(difference(x, solution(sparse, problem.K, b)), same);
    }
    // Nodes are the same, but in other groups.
    std::swap(problem.K.contact.front(), problem.K.contact.back());
    SparseSolver sparse(problem.grains());
    EXPECT_LT(difference(solution(used, problem.K, b), solution(sparse, problem.K, b)), same);
}

TEST(FrontSolver, AnySetsOfNodesMayTouch) {
    std::mt19937_64 random(7);
    Problem problem(3, 1, 3, 7);
    const auto nodes = static_cast<int>(problem.grains().nodes());
    std::normal_distribution<double> normal;
    for (int k = 0; k < 12; ++k) {
        std::vector<std::set<int>> sets;
        for (int c = 0; c < 4; ++c) {
            std::set<int> set;
            while (set.size() < 12) set.insert(static_cast<int>(random() % static_cast<unsigned>(3 * nodes)));
            sets.push_back(set);
        }
        // All nodes of a grain; all nodes at all; one node.
        if (k % 4 == 1)
            for (int m = 0; m < nodes; ++m) sets[1].insert(nodes + m);
        if (k % 4 == 2)
            for (int m = 0; m < 3 * nodes; ++m) sets[2].insert(m);
        if (k % 4 == 3) sets[3] = {2 * nodes};
        problem.K.contact.clear();
        for (const auto& set : sets) {
            const auto size = static_cast<Eigen::Index>(2 * set.size());
            MatrixXd B = MatrixXd::NullaryExpr(size, 5, [&] { return normal(random); });
            MatrixXd M = B * B.transpose();
            M.triangularView<Eigen::StrictlyUpper>().setConstant(1e30);  // not looked at
            problem.K.contact.push_back({{set.begin(), set.end()}, M});
        }
        FrontSolver front(problem.grains());
        expect_right(front, problem.grains(), problem.K, problem.load());
    }
}

TEST(LinearSolvers, TellWhatIsNotPositiveDefinite) {
    Problem problem(3, 1, 2, 8);
    problem.K.shift = 0.0;
    const auto b = problem.load();
    // Just above and below the shift that makes the least eigenvalue zero; rounding is 1e-13 of the largest.
    const MatrixXd A = dense(problem.grains(), problem.K);
    const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(A).eigenvalues();
    const double margin = 1e-8;
    ASSERT_LT(1e-13 * values.maxCoeff(), margin);
    for (const double above : {-margin, margin}) {
        problem.K.shift = -values.minCoeff() + above;
        FrontSolver front(problem.grains());
        SparseSolver sparse(problem.grains());
        EXPECT_EQ(solution(front, problem.K, b).empty(), above < 0.0);
        EXPECT_EQ(solution(sparse, problem.K, b).empty(), above < 0.0);
    }
}

TEST(FrontSolver, TellsWhetherGrainsOrContactsAreNotPositiveDefinite) {
    Problem problem(4, 2, 2, 9);
    const auto b = problem.load();
    FrontSolver front(problem.grains());
    ASSERT_FALSE(solution(front, problem.K, b).empty());
    problem.K.contact_shift = -50.0;
    EXPECT_TRUE(front.factor_grains(problem.K));
    EXPECT_FALSE(front.factor_contacts(problem.K));
    // It recovers without its grains.
    problem.K.contact_shift = 1.0;
    ASSERT_TRUE(front.factor_contacts(problem.K));
    SparseSolver sparse(problem.grains());
    const auto right = solution(sparse, problem.K, b);
    EXPECT_LT(difference(solve(front, b), right), same);

    problem.K.shift = -1.0;
    EXPECT_FALSE(front.factor_grains(problem.K));
    problem.K.shift = 1e-3;
    EXPECT_LT(difference(solution(front, problem.K, b), right), same);
    // One contact of several, one grain out of four.
    for (ContactStiffness& c : problem.K.contact) {
        c.matrix *= -1.0;
        EXPECT_TRUE(front.factor_grains(problem.K));
        EXPECT_FALSE(front.factor_contacts(problem.K));
        c.matrix *= -1.0;
    }
    for (std::size_t k = 0; k < problem.grains().pattern->size(); ++k)
        problem.K.grain[2 * problem.grains().pattern->size() + k] *= -1.0;
    EXPECT_FALSE(front.factor_grains(problem.K));
}

TEST(FrontSolver, WithoutContacts) {
    for (const int grains : {1, 3}) {
        Problem problem(4, 1, grains, 10);
        problem.touch(far_away());
        const auto b = problem.load();
        FrontSolver front(problem.grains());
        if (grains == 1) {
            ASSERT_TRUE(problem.K.contact.empty());
            expect_right(front, problem.grains(), problem.K, b);
        }
        problem.K.contact.clear();
        expect_right(front, problem.grains(), problem.K, b);
    }
}

TEST(FrontSolver, OneGrainBetweenWalls) {
    Problem problem(5, 1, 1, 11);
    ASSERT_EQ(problem.K.contact.size(), 4U);
    FrontSolver front(problem.grains());
    expect_right(front, problem.grains(), problem.K, problem.load());
}

TEST(FrontSolver, GrainsThatTouchNothingAmongThoseThatDo) {
    Problem problem(3, 2, 2, 12);
    std::erase_if(problem.K.contact, [&](const ContactStiffness& c) {
        return std::any_of(c.node.begin(), c.node.end(), [&](int m) {
            return static_cast<std::size_t>(m) / problem.grains().nodes() == 1;
        });
    });
    ASSERT_GE(problem.K.contact.size(), 4U);
    FrontSolver front(problem.grains());
    expect_right(front, problem.grains(), problem.K, problem.load());
}

TEST(FrontSolver, FewChangedSpringsAreACorrection) {
    std::mt19937_64 random(17);
    Problem problem(4, 3, 3, 17);
    const Grains& grains = problem.grains();
    const auto b = problem.load();
    std::vector<Slider> sliders;
    for (const PointContact& c : problem.contacts.points()) sliders.push_back({1.0, 0.3 * c.stiffness});
    problem.model.build(problem.contacts, sliders);
    for (Touch& a : problem.active)
        a = {random() % 2 != 0, static_cast<signed char>(static_cast<int>(random() % 3) - 1)};
    problem.model.find_stiffness(problem.active, problem.K.contact);
    FrontSolver front(grains);
    ASSERT_FALSE(solution(front, problem.K, b).empty());
    const std::vector<Touch> factored = problem.active;
    std::vector<ContactSpring> changes;
    for (const int count : {1, 3, 8, 0, 12}) {
        // From what is factored, not from the last change; some more, some less.
        problem.active = factored;
        for (int k = 0; k < count; ++k) {
            Touch& a = problem.active[random() % problem.active.size()];
            if (k % 2 == 0)
                a.presses = !a.presses;
            else
                a.slides = a.slides == 0 ? 1 : 0;
        }
        problem.model.find_changes(factored, problem.active, changes);
        ASSERT_TRUE(front.change_contacts(changes)) << count;
        Stiffness changed = problem.K;
        problem.model.find_stiffness(problem.active, changed.contact);
        SparseSolver sparse(grains);
        const auto right = solution(sparse, changed, b);
        ASSERT_FALSE(right.empty());
        EXPECT_LT(difference(solve(front, b), right), same) << count;
    }
    // Only less, only more.
    const auto pressing =
        static_cast<std::size_t>(std::ranges::find(factored, true, &Touch::presses) - factored.begin());
    const auto loose =
        static_cast<std::size_t>(std::ranges::find(factored, false, &Touch::presses) - factored.begin());
    for (const std::size_t point : {pressing, loose}) {
        problem.active = factored;
        problem.active[point].presses = !problem.active[point].presses;
        problem.model.find_changes(factored, problem.active, changes);
        ASSERT_TRUE(front.change_contacts(changes));
        Stiffness changed = problem.K;
        problem.model.find_stiffness(problem.active, changed.contact);
        SparseSolver sparse(grains);
        EXPECT_LT(difference(solve(front, b), solution(sparse, changed, b)), same) << point;
    }
    // Factoring forgets them; so many are not worth while.
    ASSERT_TRUE(front.factor_contacts(problem.K));
    SparseSolver sparse(grains);
    EXPECT_LT(difference(solve(front, b), solution(sparse, problem.K, b)), same);
    problem.model.find_changes(std::vector<Touch>(factored.size()),
                               std::vector<Touch>(factored.size(), Touch{true}), changes);
    EXPECT_FALSE(front.change_contacts(changes));
}

TEST(FrontSolver, TellsWhetherACorrectionIsPositiveDefinite) {
    Problem problem(3, 2, 2, 18);
    FrontSolver front(problem.grains());
    const auto b = problem.load();
    ASSERT_FALSE(solution(front, problem.K, b).empty());
    std::vector<ContactSpring> changes;
    std::vector<Touch> others = problem.active;
    others[0] = others[1] = Touch{};
    problem.model.find_changes(others, problem.active, changes);
    ASSERT_EQ(changes.size(), 2U);
    changes[1].stiffness *= 0.5;
    // A spring of this stiffness less leaves no stiffness at all along it.
    MatrixXd A = dense(problem.grains(), problem.K);
    VectorXd g = VectorXd::Zero(A.rows()), h = g;
    for (std::size_t k = 0; k < changes[0].node.size(); ++k)
        g.segment<2>(2 * changes[0].node[k]) += changes[0].by[k];
    for (std::size_t k = 0; k < changes[1].node.size(); ++k)
        h.segment<2>(2 * changes[1].node[k]) += changes[1].by[k];
    A += changes[1].stiffness * h * h.transpose();
    const double limit = 1.0 / g.dot(A.llt().solve(g));
    for (const double part : {0.5, 0.999, 1.001, 3.0}) {
        changes[0].stiffness = -part * limit;
        EXPECT_EQ(front.change_contacts(changes), part < 1.0) << part;
    }
}

TEST(FrontSolver, SameBitsForAnyNumberOfThreads) {
    Problem problem(5, 3, 3, 13);
    problem.K.contact_shift = 1e-2;
    const auto by = [&](int threads) {
        const int before = omp_get_max_threads();
        omp_set_num_threads(threads);
        problem.packing.grains.threads = threads > 1;
        problem.touch(problem.packing.box);
        FrontSolver front(problem.grains());
        const auto x = solution(front, problem.K, problem.load());
        omp_set_num_threads(before);
        return x;
    };
    const auto one = by(1);
    ASSERT_FALSE(one.empty());
    for (const int threads : {2, 2, 3}) EXPECT_EQ(by(threads), one);
}

TEST(FrontSolver, DissectionSavesMostOfTheWork) {
    // 872 nodes of a grain of 16 cells: a dense matrix takes n^3/3 operations; bands along a side half of the
    // square of the band times n, 35 times less.
    Problem problem(16, 1, 1, 14);
    problem.K.contact.clear();
    FrontSolver front(problem.grains());
    ASSERT_TRUE(front.factor_grains(problem.K));
    const double n = 2.0 * static_cast<double>(problem.grains().nodes());
    EXPECT_LT(front.operations(), n * n * n / 3.0 / 35.0);
}

/// Random sets of nodes, some of them empty; some nodes are in none.
std::vector<std::vector<int>> random_elements(std::mt19937_64& random, int nodes, int elements, int largest) {
    std::vector<std::vector<int>> all;
    for (int e = 0; e < elements; ++e) {
        std::set<int> set;
        const auto size = static_cast<int>(random() % static_cast<unsigned>(largest + 1));
        // Near each other, and never the last node.
        const auto first = static_cast<int>(random() % static_cast<unsigned>(nodes - 1));
        for (int k = 0; k < size; ++k)
            set.insert(std::min(nodes - 2, first + static_cast<int>(random() % 12U)));
        all.emplace_back(set.begin(), set.end());
    }
    return all;
}

/// Solves by the steps, one unknown a node.
VectorXd solve_by(const std::vector<EliminationStep>& steps, const std::vector<std::vector<int>>& elements,
                  const std::vector<MatrixXd>& matrices, VectorXd b) {
    struct Part {
        std::vector<int> node;
        MatrixXd matrix;
    };
    std::vector<Part> parts;
    for (std::size_t e = 0; e < elements.size(); ++e) parts.push_back({elements[e], matrices[e]});
    std::vector<Part> columns;
    for (const EliminationStep& step : steps) {
        std::vector<int> node = step.pivots;
        node.insert(node.end(), step.rest.begin(), step.rest.end());
        const auto size = static_cast<Eigen::Index>(node.size());
        const auto p = static_cast<Eigen::Index>(step.pivots.size()), r = size - p;
        MatrixXd front = MatrixXd::Zero(size, size);
        for (const int e : step.elements) {
            const Part& part = parts[static_cast<std::size_t>(e)];
            std::vector<Eigen::Index> at;
            for (const int m : part.node) at.push_back(std::find(node.begin(), node.end(), m) - node.begin());
            for (std::size_t a = 0; a < at.size(); ++a)
                for (std::size_t c = 0; c < at.size(); ++c)
                    front(at[a], at[c]) +=
                        part.matrix(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(c));
        }
        const MatrixXd pivots = front.topLeftCorner(p, p), below = front.bottomLeftCorner(r, p);
        const MatrixXd inverse = pivots.llt().solve(MatrixXd::Identity(p, p));
        parts.push_back({step.rest, front.bottomRightCorner(r, r) - below * inverse * below.transpose()});
        columns.push_back({node, front.leftCols(p)});
    }
    // Forward: what the pivots leave; backward: the pivots from the rest.
    for (std::size_t s = 0; s < steps.size(); ++s) {
        const auto p = static_cast<Eigen::Index>(steps[s].pivots.size());
        const MatrixXd& c = columns[s].matrix;
        VectorXd own(p);
        for (Eigen::Index k = 0; k < p; ++k) own[k] = b[columns[s].node[static_cast<std::size_t>(k)]];
        const VectorXd off = c.bottomRows(c.rows() - p) * c.topRows(p).llt().solve(own);
        for (Eigen::Index k = 0; k < off.size(); ++k)
            b[columns[s].node[static_cast<std::size_t>(p + k)]] -= off[k];
    }
    for (std::size_t s = steps.size(); s-- > 0;) {
        const auto p = static_cast<Eigen::Index>(steps[s].pivots.size());
        const MatrixXd& c = columns[s].matrix;
        VectorXd own(p), rest(c.rows() - p);
        for (Eigen::Index k = 0; k < c.rows(); ++k)
            (k < p ? own[k] : rest[k - p]) = b[columns[s].node[static_cast<std::size_t>(k)]];
        own = c.topRows(p).llt().solve(own - c.bottomRows(c.rows() - p).transpose() * rest);
        for (Eigen::Index k = 0; k < p; ++k) b[columns[s].node[static_cast<std::size_t>(k)]] = own[k];
    }
    return b;
}

TEST(Eliminate, SolvesWhatADenseMatrixSolves) {
    std::mt19937_64 random(15);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 100; ++k) {
        const int nodes = 5 + k;
        const auto elements = random_elements(random, nodes, 10 + k / 2, 3 + k % 8);
        const auto steps = eliminate(elements, static_cast<std::size_t>(nodes));
        std::vector<MatrixXd> matrices;
        MatrixXd A = MatrixXd::Zero(nodes, nodes);
        for (const auto& element : elements) {
            const auto size = static_cast<Eigen::Index>(element.size());
            const MatrixXd B = MatrixXd::NullaryExpr(size, size, [&] { return normal(random); });
            matrices.push_back(B * B.transpose() + MatrixXd::Identity(size, size));
            for (std::size_t a = 0; a < element.size(); ++a)
                for (std::size_t c = 0; c < element.size(); ++c)
                    A(element[a], element[c]) +=
                        matrices.back()(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(c));
        }
        for (int m = 0; m < nodes; ++m)
            if (A(m, m) == 0.0) A(m, m) = 1.0;  // in no element: b is left as it is
        const VectorXd b = VectorXd::NullaryExpr(nodes, [&] { return normal(random); });
        const VectorXd x = A.llt().solve(b);
        // Rounding with a condition of at most 100.
        EXPECT_LT((solve_by(steps, elements, matrices, b) - x).norm(), 1e-12 * x.norm());
    }
}

TEST(Eliminate, EveryNodeAndEveryElementOnce) {
    std::mt19937_64 random(16);
    for (int k = 0; k < 100; ++k) {
        const int nodes = 5 + k;
        const auto elements = random_elements(random, nodes, 10 + k / 2, 3 + k % 8);
        const auto steps = eliminate(elements, static_cast<std::size_t>(nodes));
        std::map<int, std::size_t> eliminated;
        std::vector<int> summed(elements.size() + steps.size(), 0);
        for (std::size_t s = 0; s < steps.size(); ++s) {
            const EliminationStep& step = steps[s];
            EXPECT_FALSE(step.pivots.empty());
            for (const auto* list : {&step.pivots, &step.rest})
                EXPECT_TRUE(std::is_sorted(list->begin(), list->end(), std::less_equal<>()));
            for (const int m : step.pivots) EXPECT_TRUE(eliminated.insert({m, s}).second) << m;
            for (const int m : step.rest) EXPECT_EQ(eliminated.count(m), 0U);
            std::set<int> front(step.pivots.begin(), step.pivots.end()), of_elements;
            front.insert(step.rest.begin(), step.rest.end());
            for (const int e : step.elements) {
                ASSERT_LT(static_cast<std::size_t>(e), elements.size() + s);
                ++summed[static_cast<std::size_t>(e)];
                const auto& node = static_cast<std::size_t>(e) < elements.size()
                                       ? elements[static_cast<std::size_t>(e)]
                                       : steps[static_cast<std::size_t>(e) - elements.size()].rest;
                of_elements.insert(node.begin(), node.end());
            }
            EXPECT_EQ(front, of_elements);
        }
        std::set<int> in_elements;
        for (std::size_t e = 0; e < elements.size() + steps.size(); ++e) {
            const auto& node = e < elements.size() ? elements[e] : steps[e - elements.size()].rest;
            EXPECT_EQ(summed[e], node.empty() ? 0 : 1);
            if (e < elements.size()) in_elements.insert(node.begin(), node.end());
        }
        EXPECT_EQ(eliminated.size(), in_elements.size());
        for (const int m : in_elements) EXPECT_EQ(eliminated.count(m), 1U);
        // Nodes of the same elements at once.
        std::map<std::set<std::size_t>, std::set<std::size_t>> steps_of;
        for (const int m : in_elements) {
            std::set<std::size_t> mine;
            for (std::size_t e = 0; e < elements.size(); ++e)
                if (std::count(elements[e].begin(), elements[e].end(), m)) mine.insert(e);
            steps_of[mine].insert(eliminated[m]);
        }
        for (const auto& [mine, at] : steps_of) EXPECT_EQ(at.size(), 1U);
    }
}

TEST(Eliminate, LeastDegreeTakesChainsAndStarsFromTheirEnds) {
    // Neither fills: a step leaves one node.
    std::vector<std::vector<int>> chain, star;
    for (int k = 0; k < 30; ++k) {
        chain.push_back({(7 * k) % 31, (7 * k + 7) % 31});
        star.push_back({0, k + 1});
    }
    for (const auto& elements : {chain, star}) {
        const auto steps = eliminate(elements, 31);
        for (const EliminationStep& step : steps) EXPECT_LE(step.rest.size(), 1U);
        EXPECT_GE(steps.size(), 30U);
    }
    // After one corner of a triangle the others share all that is left: both at once.
    const std::vector<std::vector<int>> triangle{{0, 1}, {1, 2}, {0, 2}};
    EXPECT_EQ(eliminate(triangle, 3).size(), 2U);
    EXPECT_TRUE(eliminate({}, 5).empty());
}

}  // namespace
}  // namespace softgrain::mpm
