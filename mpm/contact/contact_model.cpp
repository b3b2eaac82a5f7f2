#include "mpm/contact/contact_model.hpp"

#include <algorithm>

#include "common/at.hpp"
#include "mpm/disc/quadratic_spline.hpp"

namespace softgrain::mpm {

void ContactModel::build(const Contacts& contacts, std::span<const Slider> sliders) {
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
                             place.curvature,
                             sliders.empty() ? Slider{} : sliders[at(p)]};
            group_of_[at(p)] = static_cast<int>(g);
        }
        std::sort(node.begin(), node.end());
        node.erase(std::unique(node.begin(), node.end()), node.end());
        for (Entry& e : entry)
            e.local = static_cast<int>(std::lower_bound(node.begin(), node.end(), e.local) - node.begin());
    }
}

/// d(p - c).
Vec2 ContactModel::difference(std::size_t p, std::span<const Vec2> d) const {
    const auto& entry = entry_[at(group_of_[p])];
    const auto& node = node_[at(group_of_[p])];
    Vec2 sum = Vec2::Zero();
    for (int k = point_[p].first; k < point_[p].first + point_[p].count; ++k)
        sum += entry[at(k)].difference * d[at(node[at(entry[at(k)].local)])];
    return sum;
}

Touch ContactModel::touch(std::size_t p, const Vec2& moved) const {
    const Point& point = point_[p];
    const Slider& slider = point.slider;
    const double pull = slider.trial + slider.stiffness * point.tangent.dot(moved);
    const bool holds = slider.stiffness == 0.0 || (slider.most > 0.0 && std::abs(pull) <= slider.most);
    return {point.gap + point.normal.dot(moved) < 0.0, static_cast<signed char>(holds        ? 0
                                                                                : pull > 0.0 ? 1
                                                                                             : -1)};
}

Vec2 ContactModel::force(std::size_t p, const Vec2& moved, Touch as) const {
    const Point& point = point_[p];
    const Slider& slider = point.slider;
    const double press = as.presses ? -point.stiffness * (point.gap + point.normal.dot(moved)) : 0.0;
    const double pull =
        as.slides == 0 ? slider.trial + slider.stiffness * point.tangent.dot(moved) : as.slides * slider.most;
    return press * point.normal - pull * point.tangent;
}

double ContactModel::bound_friction(std::span<const Vec2> moved) {
    double change = 0.0;
    for (std::size_t p = 0; p < point_.size(); ++p) {
        Point& point = point_[p];
        const double gap = point.gap + point.normal.dot(moved[p]);
        const double most = point.slider.coefficient * point.stiffness * std::max(0.0, -gap);
        change = std::max(change, std::abs(most - point.slider.most));
        point.slider.most = most;
    }
    return change;
}

std::vector<double> ContactModel::most() const {
    std::vector<double> values;
    for (const Point& point : point_) values.push_back(point.slider.most);
    return values;
}

void ContactModel::find_active(std::span<const Vec2> d, std::vector<Touch>& active) const {
    active.resize(point_.size());
    for (std::size_t p = 0; p < point_.size(); ++p)
        active[p] = touch(p, d.empty() ? Vec2(Vec2::Zero()) : difference(p, d));
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
        if (point.slider.stiffness > 0.0)
            sum += point.slider.energy_at(point.slider.trial + point.slider.stiffness * b) -
                   point.slider.energy_at(point.slider.start);
        sum += 0.5 * point.stiffness * gap * gap +
               0.5 * point.bend *
                   (point.curvature * b * b + 2.0 * point.speed * b * beta + point.gap * beta * beta);
    }
    return sum;
}

void ContactModel::add_force(std::span<const Touch> active, std::span<Vec2> force) const {
    for (std::size_t p = 0; p < point_.size(); ++p) {
        const Point& point = point_[p];
        if (!active[p].presses && point.slider.stiffness == 0.0) continue;
        const auto& entry = entry_[at(group_of_[p])];
        const auto& node = node_[at(group_of_[p])];
        const Vec2 push = this->force(p, Vec2::Zero(), active[p]);
        for (int k = point.first; k < point.first + point.count; ++k)
            force[at(node[at(entry[at(k)].local)])] += entry[at(k)].difference * push;
    }
}

void ContactModel::find_changes(std::span<const Touch> from, std::span<const Touch> to,
                                std::vector<ContactSpring>& out) const {
    out.clear();
    for (std::size_t p = 0; p < point_.size(); ++p) {
        const Point& point = point_[p];
        const auto add = [&](bool before, bool after, double stiffness, const Vec2& direction) {
            if (before == after || stiffness == 0.0) return;
            ContactSpring& spring = out.emplace_back();
            spring.stiffness = after ? stiffness : -stiffness;
            for (int k = point.first; k < point.first + point.count; ++k) {
                const Entry& entry = entry_[at(group_of_[p])][at(k)];
                spring.node.push_back(node_[at(group_of_[p])][at(entry.local)]);
                spring.by.push_back(entry.difference * direction);
            }
        };
        add(from[p].presses, to[p].presses, point.stiffness, point.normal);
        add(from[p].slides == 0, to[p].slides == 0, point.slider.stiffness, point.tangent);
    }
}

/// d2(k/2 g^2) = k (dg dg + g d2g), -d2g = (kappa b b + L (b beta + beta b) + g beta beta) / (L^2 - g kappa)
/// with dg = n.(dp - dc), b = t.(dp - dc), beta = n.d(dc/dt), L = |dc/dt|, kappa = n.d2c/dt2.
void ContactModel::find_stiffness(std::span<const Touch> active, std::vector<ContactStiffness>& out) const {
    out.resize(node_.size());
#pragma omp parallel for schedule(dynamic, 4) if (grains_.threads)
    for (std::size_t g = 0; g < node_.size(); ++g) {
        ContactStiffness& K = out[g];
        K.node = node_[g];
        const auto size = static_cast<Eigen::Index>(2 * K.node.size());
        K.matrix.setZero(size, size);
        for (int p = range_[g][0]; p < range_[g][1]; ++p) {
            const Point& point = point_[at(p)];
            const double k = active[at(p)].presses ? point.stiffness : 0.0;
            const double along = active[at(p)].slides == 0 ? point.slider.stiffness : 0.0;
            if (k == 0.0 && along == 0.0 && point.bend == 0.0) continue;
            const Mat2 nn = point.normal * point.normal.transpose(),
                       tt = point.tangent * point.tangent.transpose(),
                       tn = point.tangent * point.normal.transpose();
            const Mat2 difference = k * nn + (along + point.bend * point.curvature) * tt;
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
