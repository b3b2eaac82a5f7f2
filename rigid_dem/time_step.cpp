// The largest stable time step, from each grain's stiffness sum.
//
// A spring k between i and j stores k (a_i + a_j)^2 / 2 <= k (a_i^2 + a_j^2), so that the stiffness matrix is
// below twice the sum of what each grain has for itself: K = sum k_n n n' + (1 + c) k_t s s' of its
// translation and (1 + 1/c) k_t R^2 of its rotation, for any c > 0. A wall does not move: half of that.
#include <cmath>
#include <memory>

#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {
namespace {

constexpr double least_overlap = 1e-3;  ///< of the radius

/// Bound on omega^2 of a disc with A = sum k_n n n', for one ratio k_t / k_n.
class FrequencyBound {
  public:
    FrequencyBound(double shear_ratio, double rolling) : shear_ratio_(shear_ratio), rolling_(rolling) {
        if (shear_ratio == 0.0) return;
        // Alike in translation and rotation for contacts from all sides.
        const double b = 1.0 - 3.0 * shear_ratio;
        c_ = (std::hypot(b, 4.0 * shear_ratio) - b) / (2.0 * shear_ratio);
    }

    double operator()(double xx, double xy, double yy, double inverse_mass) const {
        const double trace = xx + yy, skew = 0.5 * (xx - yy);
        const double half = std::sqrt(skew * skew + xy * xy);
        const double high = 0.5 * trace + half, low = 0.5 * trace - half;
        const double q = (1.0 + c_) * shear_ratio_;
        const double translation = q <= 1.0 ? high + q * low : low + q * high;
        const double rotation = 2.0 * shear_ratio_ * trace * (1.0 + 1.0 / c_ + rolling_);
        return 2.0 * std::max(translation, rotation) * inverse_mass;
    }

  private:
    double shear_ratio_, rolling_, c_ = 1.0;
};

}  // namespace

/// A of FrequencyBound. Not initialised, so that the thread of its block is the first to touch it.
struct RigidDem::StiffnessSum {
    double xx, xy, yy;  ///< [N/m]

    void add(double k, double nxnx, double nxny, double nyny) {
        xx += k * nxnx;
        xy += k * nxny;
        yy += k * nyny;
    }
};

double RigidDem::stable_time_step() const {
    const double zeta = law_.damping_ratio();
    return law_.safety * 2.0 / std::sqrt(frequency2_) * (std::sqrt(1.0 + zeta * zeta) - zeta);
}

/// Bound on omega^2 of all grains, for the contacts they have and two that each may have soon.
void RigidDem::find_frequency() {
    steps_measured_ = 0;
    if (clumps_) {
        frequency2_ = frequency2_of_clumps();
        return;
    }
    const auto stiffness = std::make_unique_for_overwrite<StiffnessSum[]>(record_.size());
    std::vector<double> largest(blocks_.size());
    double shear_ratio = 0.0;
    for (const Block& block : blocks_)
        if (law_.rotates && !block.shear_ratio.empty())
            shear_ratio =
                std::max(shear_ratio, *std::max_element(block.shear_ratio.begin(), block.shear_ratio.end()));
    if (law_.rotates && shear_ratio == 0.0)
        shear_ratio = stiffness_at_wall(law_, elasticity_of(0)).shear_ratio;
    const FrequencyBound bound(shear_ratio, law_.between_grains.rolling_stiffness);
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < blocks_.size(); ++b) sum_stiffness(b, stiffness.get());
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        for (const Arrival& arrival : block.arrivals) {
            const StiffnessSum& from = stiffness[arrival.copy];
            stiffness[block.first_record + arrival.grain].add(1.0, from.xx, from.xy, from.yy);
        }
        largest[b] = 0.0;
        for (std::size_t g = 0; g < block.grains; ++g) {
            const StiffnessSum& own = stiffness[block.first_record + g];
            const double per_mass = record(block, g).inverse_mass;
            const double soon =
                2.0 * stiffness_soon(order_[block.first_grain + g], mass_[order_[block.first_grain + g]]);
            largest[b] = std::max(
                {largest[b], bound(own.xx, own.xy, own.yy, per_mass), bound(soon, 0.0, 0.0, per_mass)});
        }
    }
    frequency2_ = *std::max_element(largest.begin(), largest.end());
}

double RigidDem::tangent_stiffness(double k, double overlap) const {
    return law_.hertz ? Hertz::stiffness(k, overlap) : Linear::stiffness(k, overlap);
}

/// Of a contact that the grain may have before the next look [N/m]; of Hertz's law after an impact as fast as
/// two of the fastest grains meet, or at least_overlap: without any contact there is no stiffness.
double RigidDem::stiffness_soon(std::size_t grain, double mass) const {
    const GrainElasticity own = elasticity_of(grain);
    if (!law_.hertz) {
        double largest = 0.0;
        for (const Material& m : material_) largest = std::max(largest, m.youngs_modulus);
        return in_series(law_.stiffness * own.modulus, law_.stiffness * largest);
    }
    const double k = stiffness_at_wall(law_, own).k;
    const double impact = std::pow(1.25 * mass * 4.0 * fastest2_ / k, 0.4);
    return Hertz::stiffness(k, std::max(impact, least_overlap * own.radius));
}

/// Of a block's grains and copies.
void RigidDem::sum_stiffness(std::size_t b, StiffnessSum* stiffness) const {
    const Block& block = blocks_[b];
    std::fill_n(stiffness + block.first_record, block.grains + block.halo.size(),
                StiffnessSum{0.0, 0.0, 0.0});
    for (std::size_t p = 0; p < block.pairs.size(); ++p) {
        const std::size_t i = block.pairs[p].i, j = block.pairs[p].j;
        const GrainRecord &a = record(block, i), &c = record(block, j);
        const double dx = c.x - a.x, dy = c.y - a.y, distance2 = dx * dx + dy * dy;
        const double reach = a.radius + c.radius;
        if (distance2 >= reach * reach && (block.bond.empty() || block.bond[p] == 0.0)) continue;
        const double k = tangent_stiffness(block.k[uniform_ ? 0 : p], reach - std::sqrt(distance2));
        for (const std::size_t end : {i, j})
            stiffness[block.first_record + end].add(k / distance2, dx * dx, dx * dy, dy * dy);
    }
    for (const WallContact& contact : wall_contacts_[b]) {
        const double into = wall_overlap(record_[contact.record], contact.wall, box_);
        if (into <= 0.0) continue;
        const Vec2 n = wall_normal(contact.wall);
        stiffness[contact.record].add(0.5 * tangent_stiffness(contact.stiffness.k, into), n.x() * n.x(),
                                      n.x() * n.y(), n.y() * n.y());
    }
}

}  // namespace softgrain::rigid_dem
