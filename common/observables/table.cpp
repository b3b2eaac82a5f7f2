#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/observables/coordination.hpp"
#include "common/observables/fabric.hpp"
#include "common/observables/observable.hpp"
#include "common/observables/stress.hpp"

namespace softgrain {
namespace {

double sum(std::span<const double> values) {
    double total = 0.0;
    for (double v : values) total += v;
    return total;
}

/// Of the free grains [m^2].
double undeformed_area(const GrainView& view) {
    return sum(view.reference_area.first(view.free_size()));
}

/// Of the walls or of the periodic cell.
Mat2 stress(const Frame& f) {
    return boundary_stress(f.wall_force, f.cell_stress, f.view.box);
}

double mean_stress(const Frame& f) {
    return 0.5 * stress(f).trace();
}

/// I = strain rate * d * sqrt(rho / p), d the diameter of the disc of mean area.
double inertial_number(const Frame& f) {
    const double p = mean_stress(f);
    if (f.strain_rate == 0.0) return 0.0;
    if (!(p > 0.0)) return std::nan("");
    const double mean_area = undeformed_area(f.view) / static_cast<double>(f.view.free_size());
    return f.strain_rate * 2.0 * std::sqrt(mean_area / M_PI) * std::sqrt(f.density / p);
}

double energy_residual(const Frame& f) {
    const EnergyLedger& e = f.view.energy;
    return f.initial_energy + e.external_work - e.kinetic - e.elastic - e.dissipated();
}

using N = Need;
constexpr std::array table{
    Observable{"time", "s", N::base, [](const Frame& f) { return f.view.time; }},
    Observable{"step", "", N::base, [](const Frame& f) { return static_cast<double>(f.step); }},
    Observable{"axial_strain", "", N::base, [](const Frame& f) { return f.axial_strain; }},
    Observable{"box_width", "m", N::base, [](const Frame& f) { return f.view.box.width(); }},
    Observable{"box_height", "m", N::base, [](const Frame& f) { return f.view.box.height(); }},
    Observable{"packing_fraction", "", N::area,
               [](const Frame& f) { return f.view.covered_area / f.view.box.area(); }},
    Observable{"packing_fraction_undeformed", "", N::base,
               [](const Frame& f) { return undeformed_area(f.view) / f.view.box.area(); }},
    Observable{"coordination_number", "", N::contacts,
               [](const Frame& f) { return coordination(f.view).all; }},
    Observable{"coordination_number_no_rattlers", "", N::contacts,
               [](const Frame& f) { return coordination(f.view).without_rattlers; }},
    Observable{"coordination_number_with_walls", "", N::contacts,
               [](const Frame& f) { return coordination(f.view).with_walls; }},
    Observable{"stress_xx", "N/m", N::base, [](const Frame& f) { return stress(f)(0, 0); }},
    Observable{"stress_yy", "N/m", N::base, [](const Frame& f) { return stress(f)(1, 1); }},
    Observable{"mean_stress", "N/m", N::base, mean_stress},
    Observable{"deviatoric_stress", "N/m", N::base,
               [](const Frame& f) {
                   const Mat2 s = stress(f);
                   return 0.5 * (s(0, 0) - s(1, 1));
               }},
    Observable{"love_weber_xx", "N/m", N::contacts,
               [](const Frame& f) { return love_weber_stress(f.view)(0, 0); }},
    Observable{"love_weber_yy", "N/m", N::contacts,
               [](const Frame& f) { return love_weber_stress(f.view)(1, 1); }},
    Observable{"love_weber_xy", "N/m", N::contacts,
               [](const Frame& f) {
                   const Mat2 s = love_weber_stress(f.view);
                   return 0.5 * (s(0, 1) + s(1, 0));
               }},
    Observable{"inertial_number", "", N::base, inertial_number},
    Observable{"unbalanced_force", "", N::contacts, [](const Frame& f) { return unbalanced_force(f.view); }},
    Observable{"kinetic_energy", "J", N::base, [](const Frame& f) { return f.view.energy.kinetic; }},
    Observable{"elastic_energy", "J", N::base, [](const Frame& f) { return f.view.energy.elastic; }},
    Observable{"external_work", "J", N::base, [](const Frame& f) { return f.view.energy.external_work; }},
    Observable{"dissipated_energy", "J", N::base, [](const Frame& f) { return f.view.energy.dissipated(); }},
    Observable{"energy_residual", "J", N::base, energy_residual},
    Observable{"plastic_energy", "J", N::base, [](const Frame& f) { return f.view.energy.plastic; }},
    Observable{"adhesion_energy", "J", N::base, [](const Frame& f) { return f.view.energy.adhesion; }},
    Observable{"stress_xy", "N/m", N::base, [](const Frame& f) { return stress(f)(0, 1); }},
    Observable{"shear_strain", "", N::base, [](const Frame& f) { return f.view.box.shear_strain(); }},
    Observable{"contact_penetration", "m", N::base,
               [](const Frame& f) { return f.view.contact_report.penetration; }},
    Observable{"contact_sweeps", "", N::base, [](const Frame& f) { return f.view.contact_report.sweeps; }},
    Observable{"unconverged_steps", "", N::base,
               [](const Frame& f) { return f.view.contact_report.unconverged_steps; }},
    Observable{"fragments", "", N::base, [](const Frame& f) { return f.view.fragments; }},
    Observable{"strain_xx", "", N::base,
               [](const Frame& f) { return 1.0 - f.view.box.width() / f.initial_box.width(); }},
    Observable{"strain_yy", "", N::base,
               [](const Frame& f) { return 1.0 - f.view.box.height() / f.initial_box.height(); }},
    Observable{"volumetric_strain", "", N::base,
               [](const Frame& f) { return 1.0 - f.view.box.area() / f.initial_box.area(); }},
    Observable{"rattlers", "", N::contacts,
               [](const Frame& f) { return static_cast<double>(coordination(f.view).rattlers); }},
    Observable{"fabric_anisotropy", "", N::contacts,
               [](const Frame& f) { return fabric(f.view).anisotropy; }},
    Observable{"fabric_angle", "rad", N::contacts, [](const Frame& f) { return fabric(f.view).angle; }},
    Observable{"stage", "", N::base, [](const Frame& f) { return static_cast<double>(f.stage + 1); }},
    Observable{"warnings", "", N::base, [](const Frame& f) { return f.warnings; }},
};

}  // namespace

std::span<const Observable> observables() {
    return table;
}

std::size_t observable_index(std::string_view name) {
    const auto* it =
        std::find_if(table.begin(), table.end(), [&](const Observable& o) { return o.name == name; });
    if (it == table.end()) throw std::out_of_range("no history column named " + std::string(name));
    return static_cast<std::size_t>(it - table.begin());
}

}  // namespace softgrain
