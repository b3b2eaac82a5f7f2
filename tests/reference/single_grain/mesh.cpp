#include "mesh.hpp"

#include <cmath>
#include <numbers>

namespace softgrain::reference {
namespace {

constexpr double core_edge = 0.5, core_diagonal = 0.4;  // corners of the core block, in radii

/// Point of the core at (s, t) in [0, 1]^2.
Vec2 core_point(double s, double t) {
    const double stretch = core_diagonal - core_edge;
    return {s * (core_edge + stretch * t), t * (core_edge + stretch * s)};
}

/// Point of the outer block on the x axis: r from the core to the arc, s from the axis to the diagonal.
Vec2 outer_point(double r, double s) {
    const double angle = 0.25 * std::numbers::pi * s * (0.5 + 0.5 * s);
    const double outward = r * (1.5 - 0.5 * r);
    return (1.0 - outward) * core_point(1.0, s) + outward * Vec2{std::cos(angle), std::sin(angle)};
}

Vec2 mirrored(const Vec2& p) {
    return {p.y(), p.x()};
}

/// Node numbers of one block, (2 n + 1)^2.
class Lattice {
  public:
    explicit Lattice(int n) : side_(2 * n + 1), index_(side_ * side_, -1) {}
    int& at(int i, int j) { return index_[i * side_ + j]; }

  private:
    int side_;
    std::vector<int> index_;
};

}  // namespace

Mesh quarter_disc(double radius, int n) {
    Mesh mesh;
    const int last = 2 * n;
    const double h = 1.0 / last;
    Lattice core(n), right(n), top(n);
    const auto add = [&](const Vec2& p) {
        mesh.nodes.push_back(radius * p);
        return static_cast<int>(mesh.nodes.size()) - 1;
    };
    for (int i = 0; i <= last; ++i)
        for (int j = 0; j <= last; ++j) core.at(i, j) = add(core_point(i * h, j * h));
    for (int k = 0; k <= last; ++k)
        for (int j = 0; j <= last; ++j)
            right.at(k, j) = k == 0 ? core.at(last, j) : add(outer_point(k * h, j * h));
    for (int i = 0; i <= last; ++i)
        for (int k = 0; k <= last; ++k)
            top.at(i, k) = k == 0      ? core.at(i, last)
                           : i == last ? right.at(k, last)
                                       : add(mirrored(outer_point(k * h, i * h)));

    for (Lattice* block : {&core, &right, &top})
        for (int i = 0; i < last; i += 2)
            for (int j = 0; j < last; j += 2) {
                Element element;
                for (int a = 0; a < 9; ++a) element[a] = block->at(i + a / 3, j + a % 3);
                mesh.elements.push_back(element);
            }
    for (int j = 0; j <= last; ++j) mesh.outline.push_back(right.at(last, j));
    for (int i = last - 1; i >= 0; --i) mesh.outline.push_back(top.at(i, last));
    for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
        // The mapping gives exact zeros on the axes.
        if (mesh.nodes[node].y() == 0.0) mesh.on_x_axis.push_back(node);
        if (mesh.nodes[node].x() == 0.0) mesh.on_y_axis.push_back(node);
    }
    return mesh;
}

}  // namespace softgrain::reference
