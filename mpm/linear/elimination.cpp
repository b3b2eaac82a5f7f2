#include "mpm/linear/elimination.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "common/at.hpp"

namespace softgrain::mpm {
namespace {

/// Nodes of the same elements, as one variable.
struct Variable {
    std::vector<int> nodes;
    std::vector<int> elements;  ///< ascending
    std::size_t degree = 0;     ///< nodes in its elements, its own left out
    bool eliminated = false;
};

struct Element {
    std::vector<int> variables;  ///< ascending
};

class Graph {
  public:
    Graph(std::span<const std::vector<int>> elements, std::size_t nodes);
    std::vector<EliminationStep> eliminate_all();

  private:
    std::vector<int> neighbours(int variable);
    void update_degree(int variable);
    EliminationStep eliminate(int variable);

    std::vector<Variable> variable_;
    std::vector<Element> element_;
    std::vector<char> marked_;
    std::set<std::pair<std::size_t, int>> by_degree_;
};

Graph::Graph(std::span<const std::vector<int>> elements, std::size_t nodes) {
    std::vector<std::vector<int>> elements_of(nodes);
    for (std::size_t e = 0; e < elements.size(); ++e)
        for (const int node : elements[e]) elements_of[at(node)].push_back(static_cast<int>(e));
    element_.resize(elements.size());
    std::map<std::vector<int>, int> variable_of;
    for (std::size_t node = 0; node < nodes; ++node) {
        if (elements_of[node].empty()) continue;
        const auto [it, is_new] =
            variable_of.try_emplace(elements_of[node], static_cast<int>(variable_.size()));
        if (is_new) {
            variable_.push_back({{}, elements_of[node]});
            for (const int e : elements_of[node]) element_[at(e)].variables.push_back(it->second);
        }
        variable_[at(it->second)].nodes.push_back(static_cast<int>(node));
    }
    marked_.assign(variable_.size(), 0);
    for (std::size_t v = 0; v < variable_.size(); ++v) update_degree(static_cast<int>(v));
}

/// Variables in a common element, ascending, without itself.
std::vector<int> Graph::neighbours(int variable) {
    std::vector<int> found;
    marked_[at(variable)] = 1;
    for (const int e : variable_[at(variable)].elements)
        for (const int other : element_[at(e)].variables)
            if (!marked_[at(other)]) {
                marked_[at(other)] = 1;
                found.push_back(other);
            }
    marked_[at(variable)] = 0;
    for (const int other : found) marked_[at(other)] = 0;
    std::sort(found.begin(), found.end());
    return found;
}

void Graph::update_degree(int variable) {
    Variable& v = variable_[at(variable)];
    by_degree_.erase({v.degree, variable});
    v.degree = 0;
    for (const int other : neighbours(variable)) v.degree += variable_[at(other)].nodes.size();
    by_degree_.insert({v.degree, variable});
}

EliminationStep Graph::eliminate(int variable) {
    EliminationStep step;
    step.elements = variable_[at(variable)].elements;
    const std::vector<int> near = neighbours(variable);
    const int made = static_cast<int>(element_.size());
    element_.emplace_back();
    std::vector<int> pivots{variable};
    for (const int other : near) {
        Variable& v = variable_[at(other)];
        std::vector<int> kept;
        std::set_difference(v.elements.begin(), v.elements.end(), step.elements.begin(), step.elements.end(),
                            std::back_inserter(kept));
        if (kept.empty()) {
            pivots.push_back(other);  // all that it is coupled with is here
            continue;
        }
        kept.push_back(made);
        v.elements = std::move(kept);
        element_.back().variables.push_back(other);
    }
    for (const int e : step.elements) element_[at(e)].variables.clear();
    for (const int p : pivots) {
        Variable& v = variable_[at(p)];
        by_degree_.erase({v.degree, p});
        v.eliminated = true;
        step.pivots.insert(step.pivots.end(), v.nodes.begin(), v.nodes.end());
    }
    std::sort(step.pivots.begin(), step.pivots.end());
    const std::vector<int> rest = element_.back().variables;
    for (const int other : rest) {
        const Variable& v = variable_[at(other)];
        step.rest.insert(step.rest.end(), v.nodes.begin(), v.nodes.end());
    }
    std::sort(step.rest.begin(), step.rest.end());
    for (const int other : rest) update_degree(other);
    return step;
}

std::vector<EliminationStep> Graph::eliminate_all() {
    std::vector<EliminationStep> steps;
    while (!by_degree_.empty()) steps.push_back(eliminate(by_degree_.begin()->second));
    return steps;
}

}  // namespace

std::vector<EliminationStep> eliminate(std::span<const std::vector<int>> elements, std::size_t nodes) {
    return Graph(elements, nodes).eliminate_all();
}

}  // namespace softgrain::mpm
