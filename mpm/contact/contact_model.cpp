#include "mpm/contact/contact_model.hpp"

#include <algorithm>

#include "mpm/disc/quadratic_spline.hpp"

namespace softgrain::mpm {
namespace {

std::size_t at(int k) {
    return static_cast<std::size_t>(k);
}

}  // namespace

void ContactModel::build(const Contacts& contacts) {
    const ReferenceDisc& disc = *grains_.disc;
    const int nodes = static_cast<int>(grains_.nodes()), controls = static_cast<int>(disc.control.size());
    const std::size_t groups = contacts.groups().size();
    point_.resize(contacts.points().size());
    group_of_.resize(point_.size());
    entry_.resize(groups);
    node_.resize(groups);
    range_.resize(groups);
#pragma omp parallel for schedule(dynamic, 4) if (grains_.threads)
    for (std::size_t g = 0; g < groups; ++g) {
        const ContactGroup& group = contacts.groups()[g];
        std::vector<Entry>& entry = entry_[g];
        std::vector<int>& node = node_[g];
        entry.clear();
        node.clear();
        range_[g] = {group.first, group.first + group.count};
        const auto add = [&](const ShapeRows& rows, int row, int grain, double value, double slope) {
            const auto of = rows.nodes(at(row));
            const auto N = rows.values(at(row));
            for (std::size_t k = 0; k < of.size(); ++k)
                entry.push_back({grain * nodes + of[k], value * N[k], slope * N[k]});
        };
        for (int p = group.first; p < group.first + group.count; ++p) {
            const PointContact& c = contacts.points()[at(p)];
            const std::size_t first = entry.size();
            add(disc.surface, c.point, c.i, 1.0, 0.0);
            if (c.j >= 0) {
                const SplineSpan s = spline_span(c.place.t);
                for (int k = 0; k < 3; ++k)
                    add(disc.control, (c.place.span + k) % controls, c.j, -s.value[at(k)], s.slope[at(k)]);
            }
            // Nodes that several controls share become one entry.
            std::sort(entry.begin() + static_cast<std::ptrdiff_t>(first), entry.end(),
                      [](const Entry& a, const Entry& b) { return a.local < b.local; });
            std::size_t last = first;
            for (std::size_t k = first + 1; k < entry.size(); ++k) {
                if (entry[k].local == entry[last].local) {
                    entry[last].difference += entry[k].difference;
                    entry[last].slope += entry[k].slope;
                } else {
                    entry[++last] = entry[k];
                }
            }
            entry.resize(last + 1);
            for (std::size_t k = first; k < entry.size(); ++k) node.push_back(entry[k].local);
            const CurvePlace& place = c.place;
            const double bend =
                c.j >= 0 ? c.force() / (place.speed * place.speed - place.gap * place.curvature) : 0.0;
            point_[at(p)] = {static_cast<int>(first),
                             static_cast<int>(entry.size() - first),
                             place.gap,
                             c.stiffness,
                             place.normal,
                             place.tangent,
                             bend,
                             place.speed,
                             place.curvature};
            group_of_[at(p)] = static_cast<int>(g);
        }
        std::sort(node.begin(), node.end());
        node.erase(std::unique(node.begin(), node.end()), node.end());
        for (Entry& e : entry)
            e.local = static_cast<int>(std::lower_bound(node.begin(), node.end(), e.local) - node.begin());
    }
}

void ContactModel::find_active(std::span<const Vec2> d, std::vector<char>& active) const {
    active.resize(point_.size());
    for (std::size_t p = 0; p < point_.size(); ++p) {
        const Point& point = point_[p];
        double gap = point.gap;
        if (!d.empty()) {
            const auto& entry = entry_[at(group_of_[p])];
            const auto& node = node_[at(group_of_[p])];
            Vec2 difference = Vec2::Zero();
            for (int k = point.first; k < point.first + point.count; ++k)
                difference += entry[at(k)].difference * d[at(node[at(entry[at(k)].local)])];
            gap += point.normal.dot(difference);
        }
        active[p] = gap < 0.0;
    }
}

double ContactModel::energy(std::span<const Vec2> d) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < point_.size(); ++p) {
        const Point& point = point_[p];
        const auto& entry = entry_[at(group_of_[p])];
        const auto& node = node_[at(group_of_[p])];
        Vec2 difference = Vec2::Zero(), slope = Vec2::Zero();
        for (int k = point.first; k < point.first + point.count; ++k) {
            const Vec2& x = d[at(node[at(entry[at(k)].local)])];
            difference += entry[at(k)].difference * x;
            slope += entry[at(k)].slope * x;
        }
        const double gap = std::min(0.0, point.gap + point.normal.dot(difference));
        const double b = point.tangent.dot(difference), beta = point.normal.dot(slope);
        sum += 0.5 * point.stiffness * gap * gap +
               0.5 * point.bend *
                   (point.curvature * b * b + 2.0 * point.speed * b * beta + point.gap * beta * beta);
    }
    return sum;
}

void ContactModel::add_force(std::span<const char> active, std::span<Vec2> force) const {
    for (std::size_t p = 0; p < point_.size(); ++p) {
        if (!active[p]) continue;
        const Point& point = point_[p];
        const auto& entry = entry_[at(group_of_[p])];
        const auto& node = node_[at(group_of_[p])];
        const Vec2 push = -point.stiffness * point.gap * point.normal;
        for (int k = point.first; k < point.first + point.count; ++k)
            force[at(node[at(entry[at(k)].local)])] += entry[at(k)].difference * push;
    }
}

void ContactModel::find_changes(std::span<const char> from, std::span<const char> to,
                                std::vector<ContactSpring>& out) const {
    out.clear();
    for (std::size_t p = 0; p < point_.size(); ++p) {
        if (from[p] == to[p]) continue;
        const Point& point = point_[p];
        ContactSpring& spring = out.emplace_back();
        spring.stiffness = to[p] ? point.stiffness : -point.stiffness;
        for (int k = point.first; k < point.first + point.count; ++k) {
            const Entry& entry = entry_[at(group_of_[p])][at(k)];
            spring.node.push_back(node_[at(group_of_[p])][at(entry.local)]);
            spring.by.push_back(entry.difference * point.normal);
        }
    }
}

/// d2(k/2 g^2) = k (dg dg + g d2g), -d2g = (kappa b b + L (b beta + beta b) + g beta beta) / (L^2 - g kappa)
/// with dg = n.(dp - dc), b = t.(dp - dc), beta = n.d(dc/dt), L = |dc/dt|, kappa = n.d2c/dt2.
void ContactModel::find_stiffness(std::span<const char> active, std::vector<ContactStiffness>& out) const {
    out.resize(node_.size());
#pragma omp parallel for schedule(dynamic, 4) if (grains_.threads)
    for (std::size_t g = 0; g < node_.size(); ++g) {
        ContactStiffness& K = out[g];
        K.node = node_[g];
        const auto size = static_cast<Eigen::Index>(2 * K.node.size());
        K.matrix.setZero(size, size);
        for (int p = range_[g][0]; p < range_[g][1]; ++p) {
            const Point& point = point_[at(p)];
            const double k = active[at(p)] ? point.stiffness : 0.0;
            if (k == 0.0 && point.bend == 0.0) continue;
            const Mat2 nn = point.normal * point.normal.transpose(),
                       tt = point.tangent * point.tangent.transpose(),
                       tn = point.tangent * point.normal.transpose();
            const Mat2 difference = k * nn + point.bend * point.curvature * tt;
            const Mat2 mixed = point.bend * point.speed * tn;
            const Mat2 slope = point.bend * point.gap * nn;
            const Entry* entry = entry_[g].data() + point.first;
            for (int a = 0; a < point.count; ++a) {
                const Mat2 left = entry[a].difference * difference + entry[a].slope * mixed.transpose();
                const Mat2 right = entry[a].difference * mixed + entry[a].slope * slope;
                for (int b = 0; b <= a; ++b)
                    K.matrix.block<2, 2>(2 * entry[a].local, 2 * entry[b].local) +=
                        entry[b].difference * left + entry[b].slope * right;
            }
        }
    }
}

}  // namespace softgrain::mpm
