#include "mpm/linear/front_solver.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <set>

namespace softgrain::mpm {
namespace {

std::size_t at(int k) {
    return static_cast<std::size_t>(k);
}

Eigen::Index size_of(const std::vector<int>& nodes) {
    return 2 * static_cast<Eigen::Index>(nodes.size());
}

/// Place of each node of `some` in the front of pivots and rest. All three are ascending.
std::vector<int> places(const std::vector<int>& some, const std::vector<int>& pivots,
                        const std::vector<int>& rest) {
    std::vector<int> place;
    place.reserve(some.size());
    auto p = pivots.begin();
    auto r = rest.begin();
    for (const int node : some) {
        p = std::lower_bound(p, pivots.end(), node);
        if (p != pivots.end() && *p == node) {
            place.push_back(static_cast<int>(p - pivots.begin()));
            continue;
        }
        r = std::lower_bound(r, rest.end(), node);
        place.push_back(static_cast<int>(pivots.size()) + static_cast<int>(r - rest.begin()));
    }
    return place;
}

double operations_of(const std::vector<int>& pivots, const std::vector<int>& rest) {
    const auto cube = [](double x) { return x * x * x; };
    const auto p = static_cast<double>(size_of(pivots)), r = static_cast<double>(size_of(rest));
    return (cube(p + r) - cube(r)) / 3.0;
}

/// Adds the lower triangle of a dense element to that of a front.
void add_element(const Eigen::MatrixXd& from, const std::vector<int>& place, Eigen::MatrixXd& to) {
    for (std::size_t b = 0; b < place.size(); ++b)
        for (std::size_t a = b; a < place.size(); ++a) {
            const auto block =
                from.block<2, 2>(static_cast<Eigen::Index>(2 * a), static_cast<Eigen::Index>(2 * b));
            if (place[a] >= place[b])
                to.block<2, 2>(2 * place[a], 2 * place[b]) += block;
            else
                to.block<2, 2>(2 * place[b], 2 * place[a]) += block.transpose();
        }
}

/// Factors the columns of the p first unknowns; what they leave of the others goes to `left`. False if they
/// are not positive definite.
bool reduce(Eigen::MatrixXd& matrix, Eigen::Index p, Eigen::MatrixXd& columns, Eigen::MatrixXd& left) {
    const Eigen::Index r = matrix.rows() - p;
    auto rest = matrix.bottomRightCorner(r, r);
    if (p > 0) {
        auto pivots = matrix.topLeftCorner(p, p);
        if (Eigen::internal::llt_inplace<double, Eigen::Lower>::blocked(pivots) >= 0) return false;
        auto below = matrix.bottomLeftCorner(r, p);
        pivots.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
        if (r > 0) rest.selfadjointView<Eigen::Lower>().rankUpdate(below, -1.0);
    }
    columns = matrix.leftCols(p);
    left = rest;
    return true;
}

}  // namespace

FrontSolver::Element FrontSolver::element(const Stiffness& K, int number) const {
    const std::size_t e = at(number), grains = grain_.size(), contacts = K.contact.size();
    if (e < grains) return {grain_[e].touched, grain_[e].front.back().left};
    if (e < grains + contacts) return {K.contact[e - grains].node, K.contact[e - grains].matrix};
    const Front& front = front_[e - grains - contacts];
    return {front.rest, front.left};
}

void FrontSolver::plan(const Stiffness& K) {
    bool same = planned_for_.size() == K.contact.size() && grain_.size() == grains_.size();
    for (std::size_t c = 0; same && c < K.contact.size(); ++c) same = planned_for_[c] == K.contact[c].node;
    if (same) return;
    planned_for_.clear();
    std::vector<char> touched(grains_.all_nodes(), 0);
    for (const ContactStiffness& c : K.contact) {
        planned_for_.push_back(c.node);
        for (const int node : c.node) touched[at(node)] = 1;
    }
    grain_.resize(grains_.size());
    operations_ = 0.0;
#pragma omp parallel for schedule(static)
    for (std::size_t g = 0; g < grains_.size(); ++g)
        plan_grain(g, std::span(touched).subspan(g * grains_.nodes(), grains_.nodes()));
    plan_contacts(K);
    for (const GrainFronts& grain : grain_)
        for (const Front& front : grain.front) operations_ += operations_of(front.pivots, front.rest);
    for (const Front& front : front_) operations_ += operations_of(front.pivots, front.rest);
}

/// By the dissection of the disc; nodes that a contact touches are left.
void FrontSolver::plan_grain(std::size_t g, std::span<const char> touched) {
    const Dissection& dissection = *grains_.dissection;
    GrainFronts& grain = grain_[g];
    grain.front.clear();
    grain.touched.clear();
    std::vector<char> done(touched.begin(), touched.end());                // touched, or eliminated
    std::vector<std::vector<int>> children(dissection.region.size() + 1);  // fronts that a region sums
    for (std::size_t k = 0; k < dissection.region.size(); ++k) {
        const Dissection::Region& region = dissection.region[k];
        auto& next = children[region.parent < 0 ? dissection.region.size() : at(region.parent)];
        Front front;
        std::set<int> rest;
        for (const int m : region.nodes)
            if (!touched[at(m)]) front.pivots.push_back(m);
        if (front.pivots.empty()) {
            next.insert(next.end(), children[k].begin(), children[k].end());
            continue;
        }
        for (const int m : front.pivots)
            for (const Coupling& c : dissection.coupled[at(m)])
                if (touched[at(c.node)] || !done[at(c.node)]) rest.insert(c.node);
        for (const int child : children[k])
            rest.insert(grain.front[at(child)].rest.begin(), grain.front[at(child)].rest.end());
        for (const int m : front.pivots) {
            rest.erase(m);
            done[at(m)] = 1;
        }
        front.rest.assign(rest.begin(), rest.end());
        front.elements = std::move(children[k]);
        next.push_back(static_cast<int>(grain.front.size()));
        grain.front.push_back(std::move(front));
    }
    Front last;
    for (std::size_t m = 0; m < touched.size(); ++m)
        if (touched[m]) {
            last.rest.push_back(static_cast<int>(m));
            grain.touched.push_back(static_cast<int>(g * touched.size() + m));
        }
    last.elements = std::move(children.back());
    grain.front.push_back(std::move(last));
}

/// Elements are what is left of each grain, then contacts, then what is left by fronts.
void FrontSolver::plan_contacts(const Stiffness& K) {
    std::vector<std::vector<int>> elements;
    for (const GrainFronts& grain : grain_) elements.push_back(grain.touched);
    for (const ContactStiffness& c : K.contact) elements.push_back(c.node);
    std::vector<EliminationStep> steps = eliminate(elements, grains_.all_nodes());
    front_.resize(steps.size());
    std::vector<int> level(steps.size(), 0);
    int levels = 0;
    for (std::size_t f = 0; f < steps.size(); ++f) {
        front_[f].pivots = std::move(steps[f].pivots);
        front_[f].rest = std::move(steps[f].rest);
        front_[f].elements = std::move(steps[f].elements);
        for (const int e : front_[f].elements)
            if (at(e) >= elements.size()) level[f] = std::max(level[f], level[at(e) - elements.size()] + 1);
        levels = std::max(levels, level[f] + 1);
    }
    by_level_.clear();
    level_start_.assign(1, 0);
    for (int l = 0; l < levels; ++l) {
        for (std::size_t f = 0; f < front_.size(); ++f)
            if (level[f] == l) by_level_.push_back(static_cast<int>(f));
        level_start_.push_back(static_cast<int>(by_level_.size()));
    }
}

bool FrontSolver::factor_grain(const Stiffness& K, std::size_t g) {
    const Mat2* block = K.grain.data() + g * grains_.pattern->size();
    thread_local Eigen::MatrixXd matrix;
    std::vector<int> place(grains_.nodes());
    for (Front& front : grain_[g].front) {
        const Eigen::Index p = size_of(front.pivots), r = size_of(front.rest);
        matrix.setZero(p + r, p + r);
        std::fill(place.begin(), place.end(), -1);
        int count = 0;
        for (const int m : front.pivots) place[at(m)] = count++;
        for (const int m : front.rest) place[at(m)] = count++;
        // The last front takes what is coupled among its own.
        for (const int m : front.pivots.empty() ? front.rest : front.pivots)
            for (const Coupling& c : grains_.dissection->coupled[at(m)]) {
                const int row = place[at(c.node)], column = place[at(m)];
                if (row < column) continue;
                if (c.transposed)
                    matrix.block<2, 2>(2 * row, 2 * column) = block[c.place];
                else
                    matrix.block<2, 2>(2 * row, 2 * column) = block[c.place].transpose();
                if (row == column) matrix.diagonal().segment<2>(2 * row).array() += K.shift;
            }
        for (const int e : front.elements) {
            Front& child = grain_[g].front[at(e)];
            add_element(child.left, places(child.rest, front.pivots, front.rest), matrix);
            child.left.resize(0, 0);
        }
        if (!reduce(matrix, p, front.columns, front.left)) return false;
    }
    return true;
}

bool FrontSolver::factor_front(const Stiffness& K, std::size_t f) {
    Front& front = front_[f];
    const Eigen::Index size = size_of(front.pivots) + size_of(front.rest);
    thread_local Eigen::MatrixXd matrix;
    matrix.setZero(size, size);
    for (const int e : front.elements) {
        const Element part = element(K, e);
        add_element(part.matrix, places(part.nodes, front.pivots, front.rest), matrix);
    }
    matrix.diagonal().head(size_of(front.pivots)).array() += K.contact_shift;
    return reduce(matrix, size_of(front.pivots), front.columns, front.left);
}

bool FrontSolver::factor_grains(const Stiffness& K) {
    plan(K);
    bool positive = true;
#pragma omp parallel for schedule(dynamic, 1) reduction(&& : positive)
    for (std::size_t g = 0; g < grain_.size(); ++g) positive = factor_grain(K, g) && positive;
    return positive;
}

bool FrontSolver::factor_contacts(const Stiffness& K) {
    bool positive = true;
    for (std::size_t l = 0; positive && l + 1 < level_start_.size(); ++l) {
#pragma omp parallel for schedule(dynamic, 1) reduction(&& : positive)
        for (int k = level_start_[l]; k < level_start_[l + 1]; ++k)
            positive = factor_front(K, at(by_level_[at(k)])) && positive;
    }
    return positive;
}

void FrontSolver::solve(std::span<Vec2> b) {
    Eigen::VectorXd part;
    std::span<Vec2> own;
    const auto gather = [&](const Front& front) {
        part.resize(size_of(front.pivots) + size_of(front.rest));
        Eigen::Index k = 0;
        for (const int node : front.pivots) part.segment<2>(2 * k++) = own[at(node)];
        for (const int node : front.rest) part.segment<2>(2 * k++) = own[at(node)];
    };
    const auto forward = [&](const Front& front) {
        const Eigen::Index p = size_of(front.pivots), r = size_of(front.rest);
        gather(front);
        auto pivots = part.head(p);
        front.columns.topRows(p).triangularView<Eigen::Lower>().solveInPlace(pivots);
        part.tail(r).noalias() -= front.columns.bottomRows(r) * pivots;
        Eigen::Index k = 0;
        for (const int node : front.pivots) own[at(node)] = part.segment<2>(2 * k++);
        for (const int node : front.rest) own[at(node)] = part.segment<2>(2 * k++);
    };
    const auto backward = [&](const Front& front) {
        const Eigen::Index p = size_of(front.pivots), r = size_of(front.rest);
        gather(front);
        auto pivots = part.head(p);
        pivots.noalias() -= front.columns.bottomRows(r).transpose() * part.tail(r);
        front.columns.topRows(p).triangularView<Eigen::Lower>().transpose().solveInPlace(pivots);
        Eigen::Index k = 0;
        for (const int node : front.pivots) own[at(node)] = part.segment<2>(2 * k++);
    };
    for (std::size_t g = 0; g < grain_.size(); ++g) {
        own = b.subspan(g * grains_.nodes(), grains_.nodes());
        for (const Front& front : grain_[g].front) forward(front);
    }
    own = b;
    for (const Front& front : front_) forward(front);
    for (auto front = front_.rbegin(); front != front_.rend(); ++front) backward(*front);
    for (std::size_t g = 0; g < grain_.size(); ++g) {
        own = b.subspan(g * grains_.nodes(), grains_.nodes());
        for (auto front = grain_[g].front.rbegin(); front != grain_[g].front.rend(); ++front)
            backward(*front);
    }
}

}  // namespace softgrain::mpm
