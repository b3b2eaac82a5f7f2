#include "mpm/contact/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mpm/contact/spread.hpp"

namespace softgrain::mpm {
namespace {

constexpr double skin = 0.2;        // [mean radius]
constexpr double near_gap = 0.008;  // [mean radius]

}  // namespace

void Surfaces::update(const Grains& grains, std::span<const Vec2> q) {
    const ReferenceDisc& disc = *grains.disc;
    const std::size_t controls = disc.control.size(), points = disc.surface.size();
    control.resize(grains.size() * controls);
    point.resize(grains.size() * points);
#pragma omp parallel for schedule(static) if (grains.threads)
    for (std::size_t g = 0; g < grains.size(); ++g) {
        const std::span<const Vec2> own{q.data() + g * grains.nodes(), grains.nodes()};
        for (std::size_t k = 0; k < controls; ++k) control[g * controls + k] = disc.control.at(k, own);
        for (std::size_t k = 0; k < points; ++k) point[g * points + k] = disc.surface.at(k, own);
    }
}

Contacts::Contacts(const Grains& grains, double penalty) : grains_(grains), penalty_(penalty) {
    center_.resize(grains.size());
    reach_.resize(grains.size());
    low_.resize(grains.size());
    high_.resize(grains.size());
    wall_force_.fill(Vec2::Zero());
    near_gap_ = near_gap * mean_radius();
}

double Contacts::mean_radius() const {
    double sum = 0.0;
    for (const Grain& grain : grains_.grain) sum += grain.radius;
    return sum / static_cast<double>(grains_.size());
}

void Contacts::watch(const Surfaces& surfaces) {
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        const auto controls = surfaces.controls_of(grains_, g);
        low_[g] = high_[g] = controls[0];
        for (const Vec2& x : controls) {
            low_[g] = low_[g].cwiseMin(x);
            high_[g] = high_[g].cwiseMax(x);
        }
        center_[g] = 0.5 * (low_[g] + high_[g]);
        reach_[g] = 0.0;
        for (const Vec2& x : controls) reach_[g] = std::max(reach_[g], (x - center_[g]).norm());
    }
    if (pairs_.built_at().empty() || pairs_.stale(center_, reach_))
        pairs_.build(center_, reach_, skin * mean_radius());
}

void Contacts::find_points(const Surfaces& surfaces, std::size_t i, std::size_t j, double length,
                           std::vector<PointContact>& out) const {
    const auto points = surfaces.points_of(grains_, i);
    const auto controls = surfaces.controls_of(grains_, j);
    std::optional<std::size_t> nearest;  // to the last point, if that was near
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec2& x = points[k];
        if ((x.array() < low_[j].array() - near_gap_).any() ||
            (x.array() > high_[j].array() + near_gap_).any()) {
            nearest.reset();
            continue;
        }
        nearest = nearest ? nearest_control(controls, x, *nearest) : nearest_control(controls, x);
        if (is_far_outside(controls, x, *nearest, near_gap_)) continue;
        const CurvePlace place = closest_place(controls, x, *nearest);
        if (place.gap >= near_gap_) continue;
        out.push_back(
            {static_cast<int>(i), static_cast<int>(k), static_cast<int>(j), place,
             length * contact_stiffness(penalty_, grains_.disc->spacing(), grains_.grain[i].compliance(),
                                        grains_.grain[j].compliance())});
    }
}

void Contacts::find_wall_points(const Surfaces& surfaces, const Box& box, std::size_t i, int wall,
                                std::vector<PointContact>& out) const {
    const Grain& grain = grains_.grain[i];
    const auto points = surfaces.points_of(grains_, i);
    const double length = grains_.disc->surface_weight() * grain.radius;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double gap = box.distance(wall, points[k]);
        if (gap >= near_gap_) continue;
        CurvePlace place{};
        place.gap = gap;
        place.normal = wall_normal(wall);
        place.tangent = perpendicular(place.normal);
        out.push_back({static_cast<int>(i), static_cast<int>(k), -1 - wall, place,
                       length * contact_stiffness(penalty_, grains_.disc->spacing(), grain.compliance(),
                                                  grain.compliance())});
    }
}

/// Grains and walls that are near each other.
void Contacts::find_near(const Box& box) {
    near_.clear();
    std::size_t pair = 0;
    for (std::size_t i = 0; i < grains_.size(); ++i) {
        for (int wall = 3; wall >= 0 && !box.periodic; --wall)
            if (box.distance(wall, wall_sign(wall) > 0.0 ? low_[i] : high_[i]) < near_gap_)
                near_.push_back({static_cast<int>(i), -1 - wall});
        for (; pair < pairs_.pairs().size() && pairs_.pairs()[pair].i == static_cast<int>(i); ++pair) {
            const auto j = static_cast<std::size_t>(pairs_.pairs()[pair].j);
            if ((low_[i].array() > high_[j].array() + near_gap_).any() ||
                (low_[j].array() > high_[i].array() + near_gap_).any())
                continue;
            near_.push_back({static_cast<int>(i), static_cast<int>(j)});
        }
    }
}

double Contacts::evaluate(const Surfaces& surfaces, const Box& box, std::span<Vec2> force) {
    watch(surfaces);
    wall_force_.fill(Vec2::Zero());
    find_near(box);
    found_.resize(std::max(found_.size(), near_.size()));
    const double half = 0.5 * grains_.disc->surface_weight();
#pragma omp parallel for schedule(dynamic, 4) if (grains_.threads)
    for (std::size_t n = 0; n < near_.size(); ++n) {
        found_[n].clear();
        const auto i = static_cast<std::size_t>(near_[n].i);
        if (near_[n].j < 0) {
            find_wall_points(surfaces, box, i, -1 - near_[n].j, found_[n]);
            continue;
        }
        const auto j = static_cast<std::size_t>(near_[n].j);
        find_points(surfaces, i, j, half * grains_.grain[i].radius, found_[n]);
        find_points(surfaces, j, i, half * grains_.grain[j].radius, found_[n]);
    }
    points_.clear();
    groups_.clear();
    for (std::size_t n = 0; n < near_.size(); ++n) {
        if (found_[n].empty()) continue;
        groups_.push_back(
            {near_[n].i, near_[n].j, static_cast<int>(points_.size()), static_cast<int>(found_[n].size())});
        points_.insert(points_.end(), found_[n].begin(), found_[n].end());
    }
    energy_ = 0.0;
    for (const PointContact& c : points_) {
        if (!c.touches()) continue;
        energy_ += 0.5 * c.stiffness * c.place.gap * c.place.gap;
        const Vec2 push = -c.force() * c.place.normal;  // dU/d(gap) dgap/dx
        spread_on_contact(grains_, c, push, force);
        if (c.j < 0) wall_force_[static_cast<std::size_t>(-1 - c.j)] += push;
    }
    return energy_;
}

}  // namespace softgrain::mpm
