// Energies that are found when somebody asks.
#include <cmath>

#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {
namespace {

double stored(const Parameters& law, double k, double overlap) {
    return law.hertz ? Hertz::energy(k, overlap) : Linear::energy(k, overlap);
}

/// Of the tangential and rolling springs.
double stored(const Parameters& law, const ContactMemory& memory, const ContactStiffness& s, double overlap,
              double rolling_radius) {
    const double grip = law.hertz ? memory.grip : s.shear_ratio * Linear::stiffness(s.k, overlap);
    if (grip == 0.0) return 0.0;
    const double roller = law.between_grains.rolling_stiffness * grip * rolling_radius * rolling_radius;
    return 0.5 * memory.shear * memory.shear / grip +
           (roller > 0.0 ? 0.5 * memory.moment * memory.moment / roller : 0.0);
}

}  // namespace

/// Against gravity, from the origin.
double RigidDem::height_energy() const {
    if (gravity_.isZero(0.0)) return 0.0;
    double energy = 0.0;
    each_mover([&](std::size_t grain, const GrainRecord& g, const ForceSum&) {
        if (!is_driven(grain)) energy -= gravity_.dot(Vec2{g.x, g.y}) / g.inverse_mass;
    });
    return energy;
}

/// Kinetic energy of velocities half a kick ahead, at the time of the positions.
EnergyLedger RigidDem::energy() const {
    EnergyLedger ledger = dissipated_;
    ledger.external_work += height_energy_at_start_ - height_energy();
    each_mover([&](std::size_t grain, const GrainRecord& g, const ForceSum& f) {
        if (is_driven(grain)) return;
        const double kick = 0.5 * last_dt_ * g.inverse_mass;
        Vec2 v{g.vx + f.fx * kick, g.vy + f.fy * kick};
        if (box_.periodic) v -= walls_.affine_velocity({g.x, g.y});
        ledger.kinetic += 0.5 * v.squaredNorm() / g.inverse_mass;
        if (!law_.rotates) return;
        const double R2 = g.radius * g.radius;
        const double spin = g.spin + 2.0 * kick / R2 * (g.radius * f.shear - f.lost_torque);
        ledger.kinetic += 0.25 * R2 * spin * spin / g.inverse_mass;
    });
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        for (std::size_t p = 0; p < block.pairs.size(); ++p) {
            const double into = overlap(block, p);
            const ContactMemory memory = memory_of(block, p);
            if (into <= 0.0 && memory.bond == 0.0) continue;
            const ContactStiffness stiffness = stiffness_of(block, p);
            const double radius =
                in_series(record(block, block.pairs[p].i).radius, record(block, block.pairs[p].j).radius);
            ledger.elastic += stored(law_, stiffness.k, into) + stored(law_, memory, stiffness, into, radius);
        }
        for (const WallContact& contact : wall_contacts_[b]) {
            const GrainRecord& g = record_[contact.record];
            const double into = wall_overlap(g, contact.wall, box_);
            if (into > 0.0)
                ledger.elastic += stored(law_, contact.stiffness.k, into) +
                                  stored(law_, contact.memory, contact.stiffness, into, g.radius);
        }
    }
    return ledger;
}

}  // namespace softgrain::rigid_dem
