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
#pragma omp parallel for schedule(static) if (grains_.threads)
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

void FrontSolver::Front::clear() {
    const Eigen::Index p = size_of(pivots), r = size_of(rest);
    columns.setZero(p + r, p);
    left.setZero(r, r);
}

void FrontSolver::Front::add(const Eigen::MatrixXd& from, const std::vector<int>& nodes) {
    const std::vector<int> place = places(nodes, pivots, rest);
    const int p = static_cast<int>(pivots.size());
    for (std::size_t b = 0; b < place.size(); ++b)
        for (std::size_t a = b; a < place.size(); ++a) {
            const auto block =
                from.block<2, 2>(static_cast<Eigen::Index>(2 * a), static_cast<Eigen::Index>(2 * b));
            const auto [column, row] = std::minmax(place[a], place[b]);
            auto to = column < p ? columns.block<2, 2>(2 * row, 2 * column)
                                 : left.block<2, 2>(2 * (row - p), 2 * (column - p));
            if (place[a] >= place[b])
                to += block;
            else
                to += block.transpose();
        }
}

bool FrontSolver::Front::reduce() {
    const Eigen::Index p = size_of(pivots), r = size_of(rest);
    if (p == 0) return true;
    auto top = columns.topRows(p);
    if (Eigen::internal::llt_inplace<double, Eigen::Lower>::blocked(top) >= 0) return false;
    if (r == 0) return true;
    auto below = columns.bottomRows(r);
    top.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
    left.selfadjointView<Eigen::Lower>().rankUpdate(below, -1.0);
    return true;
}

void FrontSolver::Front::forward(std::span<Vec2> x) const {
    const Eigen::Index p = size_of(pivots), r = size_of(rest);
    if (p == 0) return;
    Eigen::VectorXd own(p), others(r);
    for (std::size_t k = 0; k < pivots.size(); ++k)
        own.segment<2>(static_cast<Eigen::Index>(2 * k)) = x[at(pivots[k])];
    columns.topRows(p).triangularView<Eigen::Lower>().solveInPlace(own);
    others.noalias() = columns.bottomRows(r) * own;
    for (std::size_t k = 0; k < pivots.size(); ++k)
        x[at(pivots[k])] = own.segment<2>(static_cast<Eigen::Index>(2 * k));
    for (std::size_t k = 0; k < rest.size(); ++k)
        x[at(rest[k])] -= others.segment<2>(static_cast<Eigen::Index>(2 * k));
}

void FrontSolver::Front::backward(std::span<Vec2> x) const {
    const Eigen::Index p = size_of(pivots), r = size_of(rest);
    if (p == 0) return;
    Eigen::VectorXd own(p), others(r);
    for (std::size_t k = 0; k < pivots.size(); ++k)
        own.segment<2>(static_cast<Eigen::Index>(2 * k)) = x[at(pivots[k])];
    for (std::size_t k = 0; k < rest.size(); ++k)
        others.segment<2>(static_cast<Eigen::Index>(2 * k)) = x[at(rest[k])];
    own.noalias() -= columns.bottomRows(r).transpose() * others;
    columns.topRows(p).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
    for (std::size_t k = 0; k < pivots.size(); ++k)
        x[at(pivots[k])] = own.segment<2>(static_cast<Eigen::Index>(2 * k));
}

bool FrontSolver::factor_grain(const Stiffness& K, std::size_t g) {
    const Mat2* block = K.grain.data() + g * grains_.pattern->size();
    std::vector<int> place(grains_.nodes());
    for (Front& front : grain_[g].front) {
        front.clear();
        std::fill(place.begin(), place.end(), -1);
        int count = 0;
        for (const int m : front.pivots) place[at(m)] = count++;
        for (const int m : front.rest) place[at(m)] = count++;
        // The last front takes what is coupled among its own.
        Eigen::MatrixXd& matrix = front.pivots.empty() ? front.left : front.columns;
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
            const Front& child = grain_[g].front[at(e)];
            front.add(child.left, child.rest);
        }
        if (!front.reduce()) return false;
    }
    return true;
}

bool FrontSolver::factor_front(const Stiffness& K, std::size_t f) {
    Front& front = front_[f];
    front.clear();
    for (const int e : front.elements) {
        const Element part = element(K, e);
        front.add(part.matrix, part.nodes);
    }
    front.columns.diagonal().array() += K.contact_shift;
    return front.reduce();
}

bool FrontSolver::factor_grains(const Stiffness& K) {
    plan(K);
    bool positive = true;
#pragma omp parallel for schedule(dynamic, 1) reduction(&& : positive) if (grains_.threads)
    for (std::size_t g = 0; g < grain_.size(); ++g) positive = factor_grain(K, g) && positive;
    return positive;
}

bool FrontSolver::factor_contacts(const Stiffness& K) {
    bool positive = true;
    for (std::size_t l = 0; positive && l + 1 < level_start_.size(); ++l) {
#pragma omp parallel for schedule(dynamic, 1) reduction(&& : positive) if (grains_.threads)
        for (int k = level_start_[l]; k < level_start_[l + 1]; ++k)
            positive = factor_front(K, at(by_level_[at(k)])) && positive;
    }
    return positive;
}

void FrontSolver::begin(std::span<const Vec2> b) {
    begun_.assign(b.begin(), b.end());
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grain_.size(); ++g)
        for (const Front& front : grain_[g].front)
            front.forward(std::span(begun_).subspan(g * grains_.nodes(), grains_.nodes()));
}

void FrontSolver::solve_contacts(std::span<const Vec2> c, std::span<Vec2> x) {
    for (std::size_t m = 0; m < x.size(); ++m) x[m] = begun_[m] + c[m];
    for (const Front& front : front_) front.forward(x);
    for (auto front = front_.rbegin(); front != front_.rend(); ++front) front->backward(x);
}

void FrontSolver::finish(std::span<Vec2> x) {
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grain_.size(); ++g)
        for (auto front = grain_[g].front.rbegin(); front != grain_[g].front.rend(); ++front)
            front->backward(x.subspan(g * grains_.nodes(), grains_.nodes()));
}

}  // namespace softgrain::mpm
