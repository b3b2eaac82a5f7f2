#include "rigid_dem/parameters.hpp"

#include <cmath>

#include "common/errors.hpp"
#include "rigid_dem/restitution.hpp"

namespace softgrain::rigid_dem {
namespace {

constexpr double linear_shear_ratio = 0.5;

double plane_modulus(const GrainElasticity& g) {
    return g.modulus / (1.0 - g.poisson_ratio * g.poisson_ratio);
}

/// (2 - nu) / G [m/N].
double shear_compliance(const GrainElasticity& g) {
    return (2.0 - g.poisson_ratio) * 2.0 * (1.0 + g.poisson_ratio) / g.modulus;
}

ContactStiffness hertz(const Parameters& law, double contact_modulus, double compliance, double radius,
                       double thickness) {
    return {4.0 / 3.0 * law.stiffness * contact_modulus * std::sqrt(radius) / thickness,
            law.shear_ratio.value_or(4.0 / (compliance * contact_modulus))};
}

}  // namespace

std::span<const KeySpec> keys() {
    using enum KeyType;
    static const std::vector<KeySpec> table{
        {"normal_law",
         text,
         Value(std::string("linear")),
         "",
         "elastic normal force",
         any_number,
         {"linear", "hertz"}},
        {"stiffness", number, 1.0, "E", "stiffness of one grain against a rigid wall; a pair has half of it",
         positive},
        {"shear_ratio", number, Value(), "",
         "tangential over normal contact stiffness; 0.5 if not given, of hertz Mindlin's", positive},
        {"restitution", number, 0.5, "",
         "coefficient of restitution of a pair, sets the contact damping; 1 for none",
         Range{least_restitution, 1.0}},
        {"rolling_friction", number, 0.0, "", "largest rolling moment / (normal force * rolling radius)",
         not_negative},
        {"rolling_stiffness", number, 1.0, "",
         "rolling stiffness / (tangential stiffness * rolling radius squared)", positive},
        {"shear_cohesion", number, 1.0, "",
         "shear strength that material.cohesion adds to the Coulomb limit / its tensile strength",
         not_negative},
        {"bonds",
         text,
         Value(std::string("always")),
         "",
         "contacts that hold material.cohesion: all that form, or those of the start that have not broken",
         any_number,
         {"always", "start"}},
        {"nonviscous_damping", number, 0.0, "",
         "Cundall's: share by which forces that work are reduced, and others increased",
         Range{0.0, 1.0, false, true}},
        {"safety", number, Value(), "",
         "share of the stability limit used as time step; by itself 0.5, or 0.1 where nothing damps "
         "(restitution 1, "
         "no nonviscous_damping)",
         Range{0.0, 1.0, true}},
        {"skin", number, Value(), "smallest radius",
         "margin of the neighbour list; by the grains' motion if not given", positive},
        {"rest_tolerance", number, 0.0, "smallest radius",
         "blocks of 256 grains at rest are left out of the steps until what they touch has moved by this; 0 "
         "for none",
         not_negative},
        {"overlap_limit", number, 0.1, "smaller radius",
         "largest overlap for which discs count as rigid; the run ends there", positive},
    };
    return table;
}

std::vector<KeyFault> faults(const Settings& table) {
    std::vector<KeyFault> found;
    if (table.text("normal_law") == "hertz" && table.text("bonds") == "start")
        found.push_back({"bonds", "needs normal_law = \"linear\": bonds are springs that also pull"});
    return found;
}

Parameters parameters_of(const Scenario& scenario) {
    const Settings& table = scenario.method_settings.at("rigid_dem");
    const Material& material = scenario.material;
    Parameters law{};
    law.hertz = table.text("normal_law") == "hertz";
    law.stiffness = table.number("stiffness");
    if (table.has("shear_ratio"))
        law.shear_ratio = table.number("shear_ratio");
    else if (!law.hertz)
        law.shear_ratio = linear_shear_ratio;
    law.bonds_of_start_only = table.text("bonds") == "start";
    law.nonviscous_damping = table.number("nonviscous_damping");
    if (table.has("skin")) law.skin = table.number("skin");
    law.rest_tolerance = table.number("rest_tolerance");
    law.overlap_limit = table.number("overlap_limit");
    if (law.hertz && material.cohesion > 0.0)
        throw InputError(
            "rigid_dem.normal_law = \"hertz\" does not hold material.cohesion; take \"linear\", or set "
            "material.cohesion = 0");

    const double restitution = table.number("restitution");
    // Undamped contacts that open and close gain energy from longer steps (README.md, Limits).
    const double own_safety = restitution < 1.0 || law.nonviscous_damping > 0.0 ? 0.5 : 0.1;
    law.safety = table.has("safety") ? table.number("safety") : own_safety;
    LawConstants& c = law.between_grains;
    c.damping = 2.0 * (law.hertz ? hertz_damping_ratio(restitution) : linear_damping_ratio(restitution));
    c.friction = material.friction;
    c.rolling_friction = table.number("rolling_friction");
    c.rolling_stiffness = c.rolling_friction > 0.0 ? table.number("rolling_stiffness") : 0.0;
    c.adhesion = material.cohesion;
    c.shear_adhesion = table.number("shear_cohesion");
    c.sticks = c.adhesion > 0.0 ? 1.0 : 0.0;
    law.at_walls = c;
    law.at_walls.friction = material.wall_friction;
    law.at_walls.adhesion = law.at_walls.sticks = 0.0;

    if (c.damping > 0.0) law.features |= has_damping;
    if (c.friction > 0.0 || c.rolling_friction > 0.0) law.features |= has_friction;
    if (c.rolling_friction > 0.0) law.features |= has_rolling;
    if (c.adhesion > 0.0) law.features |= has_friction | has_adhesion;
    law.features_at_walls = law.features & (has_damping | has_rolling);
    if (law.at_walls.friction > 0.0 || c.rolling_friction > 0.0) law.features_at_walls |= has_friction;
    law.rotates = (law.features & has_friction) != 0 || material.wall_friction > 0.0;
    return law;
}

ContactStiffness stiffness_of_pair(const Parameters& law, const GrainElasticity& a,
                                   const GrainElasticity& b) {
    if (!law.hertz)
        return {in_series(law.stiffness * a.modulus, law.stiffness * b.modulus), *law.shear_ratio};
    return hertz(law, in_series(plane_modulus(a), plane_modulus(b)),
                 shear_compliance(a) + shear_compliance(b), in_series(a.radius, b.radius),
                 a.radius + b.radius);
}

ContactStiffness stiffness_at_wall(const Parameters& law, const GrainElasticity& grain) {
    if (!law.hertz) return {law.stiffness * grain.modulus, *law.shear_ratio};
    return hertz(law, plane_modulus(grain), shear_compliance(grain), grain.radius, 2.0 * grain.radius);
}

}  // namespace softgrain::rigid_dem
