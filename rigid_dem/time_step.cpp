// The largest stable time step, from each grain's stiffness sum.
//
// A spring k between i and j stores k (a_i + a_j)^2 / 2 <= k (a_i^2 + a_j^2), so that the stiffness matrix is
// below twice the sum of what each grain has for itself: K = sum k_n n n' + (1 + c) k_t s s' of its
// translation and (1 + 1/c) k_t R^2 of its rotation, for any c > 0. A wall does not move: half of that.
#include <cmath>

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
        const double trace = xx + yy, half = std::hypot(0.5 * (xx - yy), xy);
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
    std::vector<ForceSum> stiffness(record_.size());
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
    for (std::size_t b = 0; b < blocks_.size(); ++b) add_stiffness(b, stiffness);
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        for (const Arrival& arrival : block.arrivals) {
            ForceSum& to = stiffness[block.first_record + arrival.grain];
            to.fx += stiffness[arrival.copy].fx;
            to.fy += stiffness[arrival.copy].fy;
            to.shear += stiffness[arrival.copy].shear;
        }
        largest[b] = 0.0;
        for (std::size_t g = 0; g < block.grains; ++g) {
            const ForceSum& own = stiffness[block.first_record + g];
            const double per_mass = record(block, g).inverse_mass;
            const double soon =
                2.0 * stiffness_soon(order_[block.first_grain + g], mass_[order_[block.first_grain + g]]);
            largest[b] = std::max(
                {largest[b], bound(own.fx, own.fy, own.shear, per_mass), bound(soon, 0.0, 0.0, per_mass)});
        }
    }
    frequency2_ = *std::max_element(largest.begin(), largest.end());
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

/// A of a block's grains and copies: xx, xy, yy as fx, fy, shear.
void RigidDem::add_stiffness(std::size_t b, std::vector<ForceSum>& stiffness) const {
    const Block& block = blocks_[b];
    const auto add = [&](std::size_t record, double k, const Vec2& n) {
        stiffness[record].fx += k * n.x() * n.x();
        stiffness[record].fy += k * n.x() * n.y();
        stiffness[record].shear += k * n.y() * n.y();
    };
    const auto tangent = [&](double k, double overlap) {
        return law_.hertz ? Hertz::stiffness(k, overlap) : Linear::stiffness(k, overlap);
    };
    for (std::size_t p = 0; p < block.pairs.size(); ++p) {
        const double into = overlap(block, p);
        if (into <= 0.0 && (block.bond.empty() || block.bond[p] == 0.0)) continue;
        const std::size_t i = block.pairs[p].i, j = block.pairs[p].j;
        const GrainRecord &a = record(block, i), &c = record(block, j);
        const Vec2 n = Vec2{c.x - a.x, c.y - a.y}.normalized();
        const double k = tangent(block.k[uniform_ ? 0 : p], into);
        add(block.first_record + i, k, n);
        add(block.first_record + j, k, n);
    }
    for (const WallContact& contact : wall_contacts_[b]) {
        const double into = wall_overlap(record_[contact.record], contact.wall, box_);
        if (into > 0.0)
            add(contact.record, 0.5 * tangent(contact.stiffness.k, into), wall_normal(contact.wall));
    }
}

}  // namespace softgrain::rigid_dem
