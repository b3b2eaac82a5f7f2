#include "quarter_grain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace softgrain::reference {
namespace {

/// Values and slopes of the three quadratic hats on [-1, 1].
std::array<double, 3> hats(double x) {
    return {0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)};
}
std::array<double, 3> slopes(double x) {
    return {x - 0.5, -2.0 * x, x + 0.5};
}

struct Gauss {
    std::vector<double> at, weight;
};
Gauss gauss(int order) {
    if (order == 2) return {{-std::sqrt(1.0 / 3.0), std::sqrt(1.0 / 3.0)}, {1.0, 1.0}};
    return {{-std::sqrt(0.6), 0.0, std::sqrt(0.6)}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0}};
}

}  // namespace

QuarterGrain::QuarterGrain(double radius, int elements_per_side, const Material& material, Walls walls,
                           int volume_points)
    : radius_(radius),
      mesh_(quarter_disc(radius, elements_per_side)),
      material_(material),
      measured_axis_(walls == Walls::two || walls == Walls::four ? 1 : 0) {
    const auto dofs = 2 * mesh_.nodes.size();
    constraint_.assign(dofs, Constraint::free);
    for (const int node : mesh_.on_x_axis) constraint_[2 * node + 1] = Constraint::symmetry;
    for (const int node : mesh_.on_y_axis) constraint_[2 * node] = Constraint::symmetry;
    displacement_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(dofs));
    force_ = displacement_;
    tangent_.resize(displacement_.size(), displacement_.size());
    place_walls(walls);
    place_points(3, true, volume_points == 3);
    if (volume_points == 2) place_points(2, false, true);
}

/// Nodes that an oblique wall may touch get its normal and tangent as frame.
void QuarterGrain::place_walls(Walls walls) {
    frame_.assign(mesh_.nodes.size(), Mat2::Identity());
    const bool oblique = walls == Walls::six || walls == Walls::eight;
    const double turn = 2.0 * std::numbers::pi / static_cast<int>(walls);
    for (const int node : mesh_.outline) {
        if (!oblique) {
            if (walls == Walls::four) facing_a_wall_.push_back(2 * node);
            facing_a_wall_.push_back(2 * node + 1);
            continue;
        }
        const Vec2& at = mesh_.nodes[node];
        const double nearest = turn * std::round(std::atan2(at.y(), at.x()) / turn);
        if (nearest < 0.5 * turn) {
            facing_a_wall_.push_back(2 * node);
        } else if (std::abs(nearest - 0.5 * std::numbers::pi) < 1e-9) {
            facing_a_wall_.push_back(2 * node + 1);
        } else if (constraint_[2 * node] == Constraint::free) {
            const double c = std::cos(nearest), s = std::sin(nearest);
            frame_[node] << c, -s, s, c;
            facing_a_wall_.push_back(2 * node);
        }
    }
}

void QuarterGrain::place_points(int order, bool shape, bool volume) {
    const Gauss rule = gauss(order);
    for (int e = 0; e < static_cast<int>(mesh_.elements.size()); ++e)
        for (int p = 0; p < order; ++p)
            for (int q = 0; q < order; ++q) {
                const auto nx = hats(rule.at[p]), dx = slopes(rule.at[p]);
                const auto ny = hats(rule.at[q]), dy = slopes(rule.at[q]);
                Eigen::Matrix<double, 9, 2> local;
                Mat2 jacobian = Mat2::Zero();
                for (int a = 0; a < 9; ++a) {
                    local.row(a) << dx[a / 3] * ny[a % 3], nx[a / 3] * dy[a % 3];
                    jacobian += mesh_.nodes[mesh_.elements[e][a]] * local.row(a);
                }
                const double weight = std::abs(jacobian.determinant()) * rule.weight[p] * rule.weight[q];
                points_.push_back({e, shape, volume, weight, local * jacobian.inverse()});
            }
}

Tensor QuarterGrain::deformation(const Point& point) const {
    Tensor F{1.0, 0.0, 0.0, 1.0};
    const Element& element = mesh_.elements[point.element];
    for (int a = 0; a < 9; ++a) {
        const double gx = point.gradient(a, 0), gy = point.gradient(a, 1);
        const Vec2 u = frame_[element[a]] * displacement_.segment<2>(2 * element[a]);
        F += Tensor{u.x() * gx, u.x() * gy, u.y() * gx, u.y() * gy};
    }
    return F;
}

bool QuarterGrain::assemble(bool tangent) {
    using Block = Eigen::Matrix<double, 18, 18>;
    force_.setZero();
    std::vector<Block> blocks(tangent ? mesh_.elements.size() : 0, Block::Zero());
    for (const Point& point : points_) {
        const Tensor F = deformation(point);
        if (!(determinant(F) > 0.0)) return false;
        Response r;
        if (point.shape) r = shape_response(material_, F);
        if (point.volume) {
            const Response v = volume_response(material_, F);
            r.stress += v.stress;
            r.tangent += v.tangent;
        }
        Eigen::Matrix<double, 4, 18> B;  // dF by displacements
        for (int a = 0; a < 9; ++a)
            for (int c = 0; c < 2; ++c)
                for (int along = 0; along < 2; ++along)
                    B.block<2, 1>(2 * c, 2 * a + along) = frame_[mesh_.elements[point.element][a]](c, along) *
                                                          point.gradient.row(a).transpose();
        const Eigen::Matrix<double, 18, 1> f = point.weight * (B.transpose() * r.stress);
        const Element& element = mesh_.elements[point.element];
        for (int k = 0; k < 18; ++k) force_[2 * element[k / 2] + k % 2] += f[k];
        if (tangent) {
            const Eigen::Matrix<double, 4, 18> weighted = point.weight * r.tangent.lazyProduct(B);
            blocks[point.element] += B.transpose().lazyProduct(weighted);
        }
    }
    if (!tangent) return true;

    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(blocks.size() * 171 + constraint_.size());
    for (std::size_t e = 0; e < blocks.size(); ++e)
        for (int k = 0; k < 18; ++k)
            for (int l = 0; l < 18; ++l) {
                const int row = 2 * mesh_.elements[e][k / 2] + k % 2,
                          column = 2 * mesh_.elements[e][l / 2] + l % 2;
                if (row >= column) entries.emplace_back(row, column, blocks[e](k, l));
            }
    tangent_.setFromTriplets(entries.begin(), entries.end());
    return true;
}

/// Undeformed position along a degree of freedom.
double QuarterGrain::reference(Eigen::Index dof) const {
    return frame_[dof / 2].col(dof % 2).dot(mesh_.nodes[dof / 2]);
}

/// Releases pulled nodes, catches those beyond the wall; returns whether anything changed.
bool QuarterGrain::update_contacts(double limit) {
    bool changed = false;
    for (const int dof : facing_a_wall_) {
        const double gap = limit - reference(dof) - displacement_[dof];
        if (constraint_[dof] == Constraint::wall && force_[dof] > 0.0) {
            constraint_[dof] = Constraint::free;
            changed = true;
        } else if (constraint_[dof] == Constraint::free && gap < 0.0) {
            constraint_[dof] = Constraint::wall;
            changed = true;
        }
    }
    return changed;
}

/// One Newton step with the present contacts; false if the tangent has no factors.
bool QuarterGrain::solve(double limit) {
    const auto dofs = displacement_.size();
    Eigen::VectorXd given = Eigen::VectorXd::Zero(dofs);
    for (Eigen::Index k = 0; k < dofs; ++k)
        if (constraint_[k] == Constraint::wall) given[k] = limit - reference(k) - displacement_[k];
    Eigen::VectorXd right = -force_ - tangent_.selfadjointView<Eigen::Lower>() * given;
    for (Eigen::Index column = 0; column < dofs; ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(tangent_, column); entry; ++entry)
            if (constraint_[entry.row()] != Constraint::free || constraint_[column] != Constraint::free)
                entry.valueRef() = entry.row() == column ? material_.mu : 0.0;
    for (Eigen::Index k = 0; k < dofs; ++k)
        if (constraint_[k] != Constraint::free) right[k] = 0.0;
    if (!analysed_) factor_.analyzePattern(tangent_);
    analysed_ = true;
    factor_.factorize(tangent_);
    if (factor_.info() != Eigen::Success) return false;
    displacement_ += factor_.solve(right) + given;
    return true;
}

std::optional<GrainState> QuarterGrain::press(double e) {
    const double limit = radius_ * (1.0 - e);
    const double tolerance = 1e-10 * material_.mu * radius_;
    const auto saved_displacement = displacement_;
    const auto saved_constraint = constraint_;
    constexpr int most_iterations = 40;
    for (int iteration = 1; iteration <= most_iterations; ++iteration) {
        if (!assemble(true)) break;
        const bool changed = update_contacts(limit);
        double unbalanced = 0.0, misplaced = 0.0;
        for (Eigen::Index k = 0; k < force_.size(); ++k) {
            if (constraint_[k] == Constraint::free) unbalanced = std::max(unbalanced, std::abs(force_[k]));
            if (constraint_[k] == Constraint::wall)
                misplaced = std::max(misplaced, std::abs(limit - reference(k) - displacement_[k]));
        }
        if (!changed && unbalanced < tolerance && misplaced < 1e-12 * radius_)
            return measure(e, iteration - 1);
        if (!solve(limit)) break;
    }
    displacement_ = saved_displacement;
    constraint_ = saved_constraint;
    return std::nullopt;
}

GrainState QuarterGrain::measure(double e, int iterations) const {
    GrainState s{};
    s.wall_displacement = e;
    s.iterations = iterations;
    s.smallest_J = 1.0;
    double area = 0.0, first_area = 0.0;
    for (const Point& point : points_) {
        const Tensor F = deformation(point);
        const double J = determinant(F);
        if (point.shape) {
            s.energy += 4.0 * point.weight * shape_response(material_, F).energy;
            area += point.weight * J;
            first_area += point.weight;
        }
        if (point.volume) s.energy += 4.0 * point.weight * volume_response(material_, F).energy;
        s.smallest_J = std::min(s.smallest_J, J);
    }
    s.area_ratio = area / first_area;
    const auto position = [&](int node, int axis) {
        return mesh_.nodes[node][axis] + frame_[node].row(axis).dot(displacement_.segment<2>(2 * node));
    };
    for (const int node : mesh_.outline) s.half_width = std::max(s.half_width, position(node, 0));

    // Contact from its centre outwards. A constant pressure p gives the corner `a` of the edge (a, m, b) the
    // force p (4 m - 3 a - b) / 6.
    std::vector<int> nodes = mesh_.outline;
    if (measured_axis_ == 1) std::reverse(nodes.begin(), nodes.end());
    const int along = 1 - measured_axis_, last = static_cast<int>(nodes.size()) - 1;
    const auto share = [&](int corner, int step) {
        const double a = position(nodes[corner], along), m = position(nodes[corner + step], along),
                     b = position(nodes[corner + 2 * step], along);
        return std::abs(4.0 * m - 3.0 * a - b) / 6.0;
    };
    double edge_at = 0.0, edge_squared = 0.0;  // two last corners: pressure^2 falls linearly to the edge
    double last_at = 0.0, last_squared = 0.0;
    for (int k = 0; k <= last; ++k) {
        const int dof = 2 * nodes[k] + measured_axis_;
        if (constraint_[dof] != Constraint::wall || frame_[nodes[k]] != Mat2::Identity()) {
            s.contact_length_high = 2.0 * position(nodes[k], along);
            break;
        }
        s.force += -2.0 * force_[dof];
        s.contact_length_low = 2.0 * position(nodes[k], along);
        if (k % 2 != 0 || k == last) continue;
        const double pressure = -force_[dof] / (share(k, 1) + (k == 0 ? 0.0 : share(k, -1)));
        if (k == 0) s.pressure_centre = pressure;
        s.pressure_max = std::max(s.pressure_max, pressure);
        last_at = edge_at, last_squared = edge_squared;
        edge_at = position(nodes[k], along), edge_squared = pressure * pressure;
    }
    const double fall = last_squared - edge_squared;
    const double edge = fall > 0.0 ? edge_at + edge_squared * (edge_at - last_at) / fall : edge_at;
    s.contact_length =
        std::clamp(2.0 * edge, s.contact_length_low, std::max(s.contact_length_low, s.contact_length_high));
    return s;
}

}  // namespace softgrain::reference
