#include "sdem/method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/errors.hpp"
#include "common/gravity.hpp"
#include "common/refusals.hpp"
#include "sdem/laws/lens_potential.hpp"
#include "sdem/quasi_static.hpp"

namespace softgrain::sdem {

Kinematics kinematics_from(std::string_view name) {
    if (name == "D2F0") return Kinematics::D2F0;
    if (name == "D2F1") return Kinematics::D2F1;
    if (name == "D2F3") return Kinematics::D2F3;
    throw InputError(fmt::format("sdem.kinematics must be D2F0, D2F1 or D2F3, got '{}'", name));
}

namespace {

using namespace std::string_literals;

std::span<const KeySpec> keys() {
    static const std::array table{
        KeySpec{"law",
                KeyType::text,
                "lens_potential"s,
                "",
                "contact law: lens_potential (conservative) or mollon2022 (as printed)",
                any_number,
                {"lens_potential", "mollon2022"}},
        KeySpec{
            "grain_law",
            KeyType::text,
            "auto"s,
            "",
            "stress of a grain: linear as the paper's, neo_hookean; auto takes linear for mollon2022 only",
            any_number,
            {"auto", "linear", "neo_hookean"}},
        KeySpec{"kinematics",
                KeyType::text,
                "D2F3"s,
                "",
                "how a grain deforms: D2F0 rigid, D2F1 volume only, D2F3 volume and shape",
                any_number,
                {"D2F0", "D2F1", "D2F3"}},
        KeySpec{
            "safety", KeyType::number, Value(), "",
            "time step / predicted stability limit; by itself 0.8, or 0.07 where nothing damps and the law "
            "has a potential: energy is then kept to a thousandth",
            Range{0.0, 1.0, true, false}},
        KeySpec{"contact_damping", KeyType::number, 1.0, "", "gamma of Mollon 2022, Eq. 61", not_negative},
        KeySpec{"shape_damping", KeyType::number, 0.5, "",
                "damping of a grain's free oscillations: gamma of Mollon 2022, Eq. 62-64, is "
                "shape_damping * sqrt(E/rho) / R in 1/s",
                not_negative},
        KeySpec{
            "dilation_inertia", KeyType::number, Value(), "",
            "inertia added to changes of a grain's area, in units of its own; by itself as much as makes a "
            "nearly incompressible grain as slow in area as in shape",
            not_negative},
        KeySpec{
            "driver",
            KeyType::text,
            "explicit"s,
            "",
            "explicit: dynamics; quasi_static: equilibria by minimising the energy, where the law has one",
            any_number,
            {"explicit", "quasi_static"}},
        KeySpec{"strain_step", KeyType::number, QuasiStaticOptions{}.strain_step, "",
                "largest strain of the box between two equilibria, quasi_static only", positive},
        KeySpec{"tolerance", KeyType::number, QuasiStaticOptions{}.tolerance, "",
                "largest force out of balance / mean contact force, quasi_static only", positive},
        KeySpec{"tangential_stiffness", KeyType::number, 0.5, "E",
                "of the spring along a chord, with friction", positive},
        KeySpec{"adhesion_range", KeyType::number, 0.0, "grain areas",
                "loss of overlap over which cohesion builds up; 0: the same on closing and opening",
                not_negative},
        KeySpec{"geometry",
                KeyType::text,
                "batch"s,
                "",
                "how chords are found: batch (fast), scalar (its check), polygon (360 sides, as the paper)",
                any_number,
                {"batch", "scalar", "polygon"}},
        KeySpec{"skin", KeyType::number, 0.2, "mean radii", "reach of the neighbour list beyond the grains",
                positive},
        KeySpec{
            "rest_tolerance", KeyType::number, 0.0, "mean radii",
            "parts of 512 grains at rest are left out of the steps until what they touch has moved by this; "
            "0 for none; explicit only",
            not_negative},
        KeySpec{"outline_points", KeyType::integer, std::int64_t{64}, "",
                "nodes of a grain's outline in the view", Range{8.0, 4096.0}},
    };
    return table;
}

/// Bulk modulus that stands for an incompressible grain where nothing else keeps its area, in mu: areas are
/// kept to p / kappa.
constexpr double stiffest_bulk = 300.0;
/// kappa / mu up to which a grain's area needs no extra inertia: that of nu = 0.3.
constexpr double ordinary_bulk = 13.0 / 6.0;

GrainMaterial grain_material(const Material& material, const Settings& settings, ContactLaw law) {
    const double nu = material.poisson_ratio, E = material.youngs_modulus;
    if (!(nu >= 0.0 && nu <= 0.5))
        throw InputError(fmt::format("material.poisson_ratio must be 0 to 0.5, got {}", nu));
    GrainMaterial m;
    m.E = E;
    m.density = material.density;
    m.mu = E / (2.0 * (1.0 + nu));
    m.plane_E = E / (1.0 - nu * nu);
    m.bulge = LensPotential::bulge(nu);
    if (law == ContactLaw::mollon2022) {
        m.kappa = nu < 0.5 ? E / (3.0 - 6.0 * nu) : 0.0;  // Eq. 65, 66
        m.dilation_inertia = 0.0;
    } else {
        m.kappa = std::min(nu < 0.5 ? E / (3.0 - 6.0 * nu) : stiffest_bulk * m.mu, stiffest_bulk * m.mu);
        m.dilation_inertia = std::max(0.0, m.kappa / m.mu / ordinary_bulk - 1.0);
    }
    if (settings.has("dilation_inertia")) m.dilation_inertia = settings.number("dilation_inertia");
    m.shape_damping = settings.number("shape_damping") * std::sqrt(E / material.density);
    // Mises stress in plane strain: the largest shear is yield / sqrt(3).
    m.yield = material.yield_stress ? *material.yield_stress / std::numbers::sqrt3
                                    : std::numeric_limits<double>::infinity();
    return m;
}

constexpr std::array refusals{
    Refusal{Feature::clumps, "its grains are discs or ellipses"},
    Refusal{Feature::driven_grains, "its grains deform"},
};

std::unique_ptr<Solver> make(const Scenario& scenario, const Packing& packing) {
    refuse(scenario, packing, "sdem", refusals);
    if (packing.size() == 0)
        throw InputError("sdem: the packing has no grain; give packing.path or packing.count");
    const auto table = scenario.method_settings.find("sdem");
    const Settings settings = table == scenario.method_settings.end() ? Settings(keys()) : table->second;

    Options options;
    MotionLaw& motion = options.motion;
    motion.kinematics = kinematics_from(settings.text("kinematics"));
    motion.contact_law =
        settings.text("law") == "mollon2022" ? ContactLaw::mollon2022 : ContactLaw::lens_potential;
    const bool printed = motion.contact_law == ContactLaw::mollon2022;
    motion.grain_law =
        settings.text("grain_law") == "linear" || (printed && settings.text("grain_law") == "auto")
            ? GrainLaw::linear
            : GrainLaw::neo_hookean;
    motion.gravity = gravity_of(scenario, packing);
    motion.shape_damping = settings.number("shape_damping") > 0.0;
    std::vector<GrainMaterial> materials;
    for (std::size_t c = 0; c < scenario.class_count(); ++c) {
        const Material& material = scenario.material_of(c);
        materials.push_back(grain_material(material, settings, motion.contact_law));
        motion.dilation_inertia = motion.dilation_inertia || materials.back().dilation_inertia > 0.0;
        motion.plastic = motion.plastic || material.yield_stress;
        if (printed && material.poisson_ratio == 0.5) motion.imposes_area = true;
    }
    if (motion.imposes_area)
        for (std::size_t c = 0; c < scenario.class_count(); ++c)
            if (scenario.material_of(c).poisson_ratio != 0.5)
                throw InputError(
                    "sdem.law = \"mollon2022\" cannot mix grains of poisson_ratio 0.5 with others; use "
                    "sdem.law = \"lens_potential\"");
    if (motion.plastic && (printed || motion.grain_law != GrainLaw::neo_hookean))
        throw InputError(
            "material.yield_stress needs sdem.law = \"lens_potential\" and sdem.grain_law = \"neo_hookean\"");
    if (motion.plastic && motion.kinematics != Kinematics::D2F3)
        throw InputError(
            "material.yield_stress needs sdem.kinematics = \"D2F3\": other grains keep their shape");

    options.sliding.friction = scenario.material.friction;
    options.sliding.wall_friction = scenario.material.wall_friction;
    options.sliding.cohesion = scenario.material.cohesion;
    options.sliding.stiffness = settings.number("tangential_stiffness");
    options.sliding.adhesion_range = settings.number("adhesion_range");
    options.contact_damping = settings.number("contact_damping");
    const bool damped = options.contact_damping > 0.0 || motion.shape_damping;
    options.safety = settings.has("safety") ? settings.number("safety") : damped || printed ? 0.8 : 0.07;
    options.skin = settings.number("skin");
    options.rest_tolerance = settings.number("rest_tolerance");
    if (options.rest_tolerance > 0.0 && motion.imposes_area)
        throw InputError(
            "sdem.rest_tolerance is not for sdem.law = \"mollon2022\" with poisson_ratio 0.5, which imposes "
            "areas; take it out, or use sdem.law = \"lens_potential\"");
    options.outline_points = static_cast<int>(settings.integer("outline_points"));
    const std::string_view geometry = settings.text("geometry");
    options.geometry = geometry == "batch"    ? Geometry::batch
                       : geometry == "scalar" ? Geometry::scalar
                                              : Geometry::polygon;
    if (settings.text("driver") == "explicit")
        return std::make_unique<SoftDiscSolver>(std::move(materials), packing, options);

    if (options.rest_tolerance > 0.0)
        throw InputError(
            "sdem.driver = \"quasi_static\" moves all grains; take out sdem.rest_tolerance or use "
            "sdem.driver = \"explicit\"");
    if (printed)
        throw InputError(
            "sdem.driver = \"quasi_static\" minimises an energy, and sdem.law = \"mollon2022\" has none; use "
            "sdem.law = \"lens_potential\" or sdem.driver = \"explicit\"");
    if (options.sliding.needs_history())
        throw InputError(
            "sdem.driver = \"quasi_static\" minimises an energy, and friction or an adhesion_range has none; "
            "set "
            "them to 0 or use sdem.driver = \"explicit\"");
    if (motion.kinematics != Kinematics::D2F3)
        throw InputError("sdem.driver = \"quasi_static\" needs sdem.kinematics = \"D2F3\"");
    options.contact_damping = 0.0;
    motion.shape_damping = false;
    return std::make_unique<QuasiStaticSolver>(
        std::move(materials), packing, options,
        QuasiStaticOptions{settings.number("strain_step"), settings.number("tolerance")});
}

}  // namespace

const Method& method() {
    static const Method row{.name = "sdem",
                            .title = "SDEM: soft discs with six degrees of freedom (Mollon 2022)",
                            .keys = keys,
                            .make = make,
                            .not_given = "contact_penetration, contact_sweeps, unconverged_steps, fragments",
                            .refusals = refusals};
    return row;
}

}  // namespace softgrain::sdem
