#include "mpm/linear/front_solver.hpp"

#include <algorithm>

#include "common/at.hpp"

namespace softgrain::mpm {
namespace {

/// A subtree with fewer operations is one thread's; a front with more is shared.
constexpr double worth_a_task = 1e6, worth_sharing = 2e7;
/// Operations of a factorization that are as fast as one of a correction of low rank.
constexpr double slower_correction = 2.0;

}  // namespace

void FrontSolver::plan(const Stiffness& K) {
    bool same = planned_for_.size() == K.contact.size() && grain_.size() == grains_.size();
    for (std::size_t c = 0; same && c < K.contact.size(); ++c) same = planned_for_[c] == K.contact[c].node;
    if (same) return;
    planned_for_.clear();
    for (const ContactStiffness& c : K.contact) planned_for_.push_back(c.node);
    plan_contacts(K);
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grains_.size(); ++g) plan_grain(g);
    grain_operations_ = 0.0;
    for (const GrainFronts& grain : grain_)
        for (const Front& front : grain.front) grain_operations_ += front.operations();
}

/// Elements are what is left of each grain, then contacts, then what is left by fronts.
void FrontSolver::plan_contacts(const Stiffness& K) {
    const std::size_t all = grains_.all_nodes(), grains = grains_.size(), contacts = K.contact.size();
    std::vector<char> touched(all, 0);
    for (const ContactStiffness& c : K.contact)
        for (const int node : c.node) touched[at(node)] = 1;
    grain_.resize(grains);
    std::vector<std::vector<int>> elements;
    for (std::size_t g = 0; g < grains; ++g) {
        grain_[g].touched.clear();
        for (std::size_t m = g * grains_.nodes(); m < (g + 1) * grains_.nodes(); ++m)
            if (touched[m]) grain_[g].touched.push_back(static_cast<int>(m));
        elements.push_back(grain_[g].touched);
    }
    for (const ContactStiffness& c : K.contact) elements.push_back(c.node);
    std::vector<EliminationStep> steps = eliminate(elements, all);

    tree_.rank.assign(all, -1);
    tree_.front_of.assign(all, -1);
    int next = 0;
    for (std::size_t f = 0; f < steps.size(); ++f)
        for (const int node : steps[f].pivots) {
            tree_.rank[at(node)] = next++;
            tree_.front_of[at(node)] = static_cast<int>(f);
        }
    const auto sort = [&](std::vector<int>& nodes) {
        std::sort(nodes.begin(), nodes.end(),
                  [&](int a, int b) { return tree_.rank[at(a)] < tree_.rank[at(b)]; });
    };
    for (GrainFronts& grain : grain_) sort(grain.touched);
    for (EliminationStep& step : steps) sort(step.rest);

    tree_.front.resize(steps.size());
    tree_.parent.assign(steps.size(), -1);
    tree_.runs.assign(steps.size(), {});
    grain_runs_.assign(grains, {});
    contact_place_.assign(contacts, {});
    subtree_operations_.assign(steps.size(), 0.0);
    contact_operations_ = contact_numbers_ = 0.0;
    for (std::size_t f = 0; f < steps.size(); ++f) {
        Front& front = tree_.front[f];
        front.pivots = std::move(steps[f].pivots);
        front.rest = std::move(steps[f].rest);
        front.elements = std::move(steps[f].elements);
        const double own = front.operations();
        contact_operations_ += own;
        contact_numbers_ +=
            4.0 * static_cast<double>(front.pivots.size() * (front.pivots.size() + front.rest.size()));
        subtree_operations_[f] += own;
        for (const int element : front.elements) {
            const std::size_t e = at(element);
            if (e < grains) {
                grain_runs_[e] = runs_of(tree_.places(grain_[e].touched, front));
            } else if (e < grains + contacts) {
                contact_place_[e - grains] = tree_.places(K.contact[e - grains].node, front);
            } else {
                const std::size_t child = e - grains - contacts;
                tree_.runs[child] = runs_of(tree_.places(tree_.front[child].rest, front));
                tree_.parent[child] = static_cast<int>(f);
                subtree_operations_[f] += subtree_operations_[child];
            }
        }
    }
}

/// By the dissection of the disc; nodes that a contact touches are left.
void FrontSolver::plan_grain(std::size_t g) {
    const Dissection& dissection = *grains_.dissection;
    const std::size_t nodes = grains_.nodes(), regions = dissection.region.size();
    GrainFronts& grain = grain_[g];
    grain.front.clear();
    std::vector<int> touched;
    for (const int m : grain.touched) touched.push_back(m - static_cast<int>(g * nodes));
    FrontTree order;
    order.rank.assign(nodes, 0);
    int next = static_cast<int>(nodes);
    for (const int m : touched) order.rank[at(m)] = next++;
    next = 0;
    for (const auto& region : dissection.region)
        for (const int m : region.nodes)
            if (order.rank[at(m)] < static_cast<int>(nodes)) order.rank[at(m)] = next++;
    const auto earlier = [&](int a, int b) { return order.rank[at(a)] < order.rank[at(b)]; };

    std::vector<std::vector<int>> children(regions + 1);  // fronts that a region sums
    for (std::size_t k = 0; k < regions; ++k) {
        const Dissection::Region& region = dissection.region[k];
        auto& beyond = children[region.parent < 0 ? regions : at(region.parent)];
        Front front;
        for (const int m : region.nodes)
            if (order.rank[at(m)] < static_cast<int>(nodes)) front.pivots.push_back(m);
        if (front.pivots.empty()) {
            beyond.insert(beyond.end(), children[k].begin(), children[k].end());
            continue;
        }
        const int last = order.rank[at(front.pivots.back())];
        for (const int m : front.pivots)
            for (const Coupling& c : dissection.coupled[at(m)])
                if (order.rank[at(c.node)] > last) front.rest.push_back(c.node);
        for (const int child : children[k])
            for (const int m : grain.front[at(child)].rest)
                if (order.rank[at(m)] > last) front.rest.push_back(m);
        std::sort(front.rest.begin(), front.rest.end(), earlier);
        front.rest.erase(std::unique(front.rest.begin(), front.rest.end()), front.rest.end());
        front.elements = std::move(children[k]);
        beyond.push_back(static_cast<int>(grain.front.size()));
        grain.front.push_back(std::move(front));
    }
    Front left;
    left.rest = std::move(touched);
    left.elements = std::move(children.back());
    grain.front.push_back(std::move(left));
    grain.runs.assign(grain.front.size(), {});
    for (const Front& front : grain.front)
        for (const int e : front.elements)
            grain.runs[at(e)] = runs_of(order.places(grain.front[at(e)].rest, front));
}

bool FrontSolver::factor_grain(const Stiffness& K, std::size_t g) {
    const Mat2* block = K.grain.data() + g * grains_.pattern->size();
    const Mat2 shift = K.shift * Mat2::Identity();
    std::vector<int> place(grains_.nodes());
    for (Front& front : grain_[g].front) {
        front.begin();
        std::fill(place.begin(), place.end(), -1);
        int count = 0;
        for (const int m : front.pivots) place[at(m)] = count++;
        for (const int m : front.rest) place[at(m)] = count++;
        // The last front takes what is coupled among its own.
        for (const int m : front.pivots.empty() ? front.rest : front.pivots) {
            const int column = place[at(m)];
            for (const Coupling& c : grains_.dissection->coupled[at(m)]) {
                const int row = place[at(c.node)];
                if (row < column) continue;
                const Mat2& found = block[c.place];
                front.add(row, column, c.transposed ? found : Mat2(found.transpose()));
            }
            front.add(column, column, shift);
        }
        const auto sum = [&](Front::Part part) {
            for (const int e : front.elements)
                front.add(part, grain_[g].front[at(e)].left(), grain_[g].runs[at(e)]);
        };
        sum(Front::Part::columns);
        if (!front.reduce()) return false;
        sum(Front::Part::left);
        for (const int e : front.elements) grain_[g].front[at(e)].forget_left();
    }
    return true;
}

void FrontSolver::factor_front(const Stiffness& K, std::size_t f) {
    Front& front = tree_.front[f];
    const std::size_t grains = grain_.size(), contacts = K.contact.size();
    const auto sum = [&](Front::Part part) {
        for (const int element : front.elements) {
            const std::size_t e = at(element);
            if (e < grains) {
                front.add(part, grain_[e].front.back().left(), grain_runs_[e]);
            } else if (e < grains + contacts) {
                front.add(part, K.contact[e - grains].matrix, contact_place_[e - grains]);
            } else {
                const std::size_t child = e - grains - contacts;
                front.add(part, tree_.front[child].left(), tree_.runs[child]);
            }
        }
    };
    front.begin();
    sum(Front::Part::columns);
    front.shift_pivots(K.contact_shift);
    if (!front.reduce(grains_.threads && front.operations() > worth_sharing)) {
        positive_ = false;
        return;
    }
    sum(Front::Part::left);
    for (const int element : front.elements)
        if (at(element) >= grains + contacts) tree_.front[at(element) - grains - contacts].forget_left();
}

void FrontSolver::factor_subtree(const Stiffness& K, std::size_t f) {
    const std::size_t given = grain_.size() + K.contact.size();
    for (const int element : tree_.front[f].elements) {
        if (at(element) < given) continue;
        const std::size_t child = at(element) - given;
        if (subtree_operations_[child] < worth_a_task) {
            factor_subtree(K, child);
            continue;
        }
#pragma omp task shared(K) firstprivate(child)
        factor_subtree(K, child);
    }
#pragma omp taskwait
    if (positive_) factor_front(K, f);
}

bool FrontSolver::factor_grains(const Stiffness& K) {
    plan(K);
    change_.clear();
    bool positive = true;
#pragma omp parallel for schedule(dynamic, 1) reduction(&& : positive) if (grains_.threads)
    for (std::size_t g = 0; g < grain_.size(); ++g) positive = factor_grain(K, g) && positive;
    return positive;
}

bool FrontSolver::factor_contacts(const Stiffness& K) {
    change_.clear();
    positive_ = true;
#pragma omp parallel if (grains_.threads)
#pragma omp single
    for (std::size_t f = 0; f < tree_.front.size(); ++f)
        if (tree_.parent[f] < 0) factor_subtree(K, f);
    return positive_;
}

bool FrontSolver::change_contacts(std::span<const ContactSpring> added) {
    const double operations = 2.0 * contact_numbers_ * static_cast<double>(added.size());
    if (slower_correction * operations > contact_operations_) return false;
    return change_.set(added, tree_);
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
    for (const Front& front : tree_.front) front.forward(x);
    change_.correct(tree_, x);
    for (auto front = tree_.front.rbegin(); front != tree_.front.rend(); ++front) front->backward(x);
}

void FrontSolver::finish(std::span<Vec2> x) {
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grain_.size(); ++g)
        for (auto front = grain_[g].front.rbegin(); front != grain_[g].front.rend(); ++front)
            front->backward(x.subspan(g * grains_.nodes(), grains_.nodes()));
}

}  // namespace softgrain::mpm
