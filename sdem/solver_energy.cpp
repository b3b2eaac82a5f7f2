// The energy of the sample, and where it goes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "sdem/laws/lens_potential.hpp"
#include "sdem/laws/plastic_flow.hpp"
#include "sdem/solver.hpp"

namespace softgrain::sdem {

/// Work of walls or cell that move like this for dt; the share that dashpots at the boundary take goes to
/// `damping`. Without a potential the rest counts as stored. flux: of the momentum that grains carry against
/// the flow of the cell, times its area.
void SoftDiscSolver::add_boundary_work(EnergyLedger& ledger, const WallMotion& walls, const Tensor& flux,
                                       double dt) const {
    double work = 0.0, damped = 0.0;
    if (walls.box.periodic) {
        const Mat2 L = walls.velocity_gradient();
        const double area = walls.box.area();
        work = -dt * (area * cell_stress_.total + matrix_of(flux)).cwiseProduct(L).sum();
        damped = -dt * area * cell_stress_.damping.cwiseProduct(L).sum();
    } else {
        for (std::size_t w = 0; w < 4; ++w) {
            const int axis = wall_axis(static_cast<int>(w));
            const double moved = walls.velocity[w] * dt;
            work -= wall_force_[w][axis] * moved;
            damped -= wall_damping_force_[w][axis] * moved;
        }
    }
    ledger.external_work += work;
    ledger.damping += damped;
    if (!has_potential()) ledger.elastic += work - damped;
}

LensPotential::Sums SoftDiscSolver::overlaps(std::size_t g) const {
    const Grain& grain = grains_.grain[g];
    const double area = grain.reference_area() * grain.F.det();
    LensPotential::Sums sums;
    contact_view().each_side_of(
        g, [&](const Side& side) { sums.add(LensPotential::overlap(side.gives_way() / area)); });
    return sums;
}

double SoftDiscSolver::area_ratio(std::size_t g, const LensPotential::Sums& contacts) const {
    return grains_.grain[g].F.det() *
           (1.0 - LensPotential::inflation(contacts, grains_.material_of(g).bulge).G);
}

double SoftDiscSolver::grain_energy() const {
    double sum = 0.0;
    for (std::size_t g = 0; g < size(); ++g) {
        const Grain& grain = grains_.grain[g];
        const GrainMaterial& m = grains_.material_of(g);
        const double area = grain.reference_area();
        const double J = grain.F.det();
        const LensPotential::Sums contacts = overlaps(g);
        const double ratio = area_ratio(g, contacts);
        double density = LensPotential::contact_energy(m.plane_E, J, contacts);
        if (options_.motion.grain_law == GrainLaw::linear) {
            const double d = half_stretch_difference(grain.F);
            density += 2.0 * m.mu * d * d + 0.5 * m.kappa * (ratio - 1.0) * (ratio - 1.0);
        } else {
            PlasticState strain{1.0, 0.0, 1.0};
            if (options_.motion.plastic)
                strain = {memory_.plastic_xx[g], memory_.plastic_xy[g], memory_.plastic_yy[g]};
            const PlasticState b = elastic_strain(grain.F, strain);
            density +=
                0.5 * m.mu * (b.xx + b.yy - 2.0) + LensPotential::dilation_energy(ratio, m.mu, m.kappa);
        }
        sum += area * density;
    }
    return sum;
}

double SoftDiscSolver::potential_energy() const {
    return grain_energy() + stored_energy(options_.sliding, grains_, contacts_);
}

double SoftDiscSolver::height_energy() const {
    const Vec2& gravity = options_.motion.gravity;
    if (gravity.isZero(0.0)) return 0.0;
    double sum = 0.0;
    for (std::size_t g = 0; g < size(); ++g) sum -= grains_.grain[g].mass * gravity.dot(grains_.center[g]);
    return sum;
}

/// The ledger at the present positions: half a step further than the velocities kept.
EnergyLedger SoftDiscSolver::energy() const {
    EnergyLedger ledger = ledger_;
    Tensor flux{0.0, 0.0, 0.0, 0.0};
    const MotionInput input = motion_input();
    const Chunks grains = blocks();
    for (std::size_t block = 0; block < grains.count(); ++block) {
        if (block_rests(block)) continue;
        const StepWork work = kick_work(input, grains_, memory_, {2.0 * lag_, lag_, 0.0}, grains.begin(block),
                                        grains.end(block));
        ledger.damping += work.damped;
        ledger.kinetic += work.kinetic;
        if (!has_potential()) ledger.elastic += work.stored;
        flux = flux + work.flux;
    }
    add_boundary_work(ledger, motion_, flux, lag_);
    const double fallen = height_energy_at_start_ - height_energy();
    ledger.external_work += fallen;
    if (has_potential())
        ledger.elastic = potential_energy();
    else
        ledger.elastic += fallen;  // the kicks by weights count as taken from what is stored
    return ledger;
}

/// A step beyond the stability limit feeds energy in. The law as printed has no potential; that of the other
/// law is then a fair measure, as far as a factor goes.
void SoftDiscSolver::watch_energy() {
    constexpr int steps_between = 128;
    constexpr double largest_gain = 0.05, largest_gain_without_potential = 1.0, rounding = 1e-12;
    if (steps_ % steps_between != 0) return;
    const EnergyLedger ledger = energy();
    const double in_grains = grain_energy();
    const double in_contacts = stored_energy(options_.sliding, grains_, contacts_);  // negative if cohesive
    const Balance now{ledger.kinetic + in_grains + in_contacts + ledger.dissipated() - ledger.external_work,
                      ledger.kinetic + in_grains + std::abs(in_contacts), ledger.external_work, true};
    const double gain = now.energy - balance_.energy;
    const double allowed = has_potential() ? largest_gain : largest_gain_without_potential;
    const double scale = balance_.held + std::abs(now.external_work - balance_.external_work) +
                         rounding * stress_scale() * motion_.box.area();
    if (balance_.watched && !(gain <= allowed * scale)) {
        std::size_t fastest = 0;
        for (std::size_t g = 1; g < size(); ++g)
            if (grains_.grain[g].F_rate.squared() > grains_.grain[fastest].F_rate.squared()) fastest = g;
        throw DivergedError(
            packing_index(fastest), "energy", time_,
            fmt::format("{:.3g} J came from nowhere in {} steps, with {:.3g} J in all; use a smaller "
                        "sdem.safety",
                        gain, steps_between, now.held));
    }
    balance_ = now;
}

}  // namespace softgrain::sdem
