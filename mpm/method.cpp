#include "mpm/method.hpp"

#include <fmt/format.h>

#include <array>

#include "common/errors.hpp"
#include "common/refusals.hpp"
#include "mpm/solver.hpp"

namespace softgrain::mpm {
namespace {

constexpr int points_per_cell = 2;  // along a side

LawKind law_named(const std::string& name) {
    if (name == "saint_venant_kirchhoff") return LawKind::saint_venant_kirchhoff;
    if (name == "linear") return LawKind::linear;
    return LawKind::neo_hookean;
}

std::vector<KeyFault> faults_of(const Settings& settings) {
    std::vector<KeyFault> faults;
    if (settings.integer("points_across_radius") % points_per_cell != 0)
        faults.push_back({"points_across_radius", "must be even: a grid cell has 2 x 2 points"});
    if (settings.boolean("mean_dilatation") && law_named(settings.text("law")) != LawKind::neo_hookean)
        faults.push_back({"mean_dilatation", "is for law = \"neo_hookean\"; leave it out"});
    return faults;
}

std::span<const KeySpec> keys() {
    static const std::array<KeySpec, 7> table{{
        {"law",
         KeyType::text,
         std::string("neo_hookean"),
         "",
         "what grains are made of; material.yield_stress makes neo-Hookean grains elasto-plastic; \"linear\" "
         "is for "
         "small strains without rotation only",
         any_number,
         {"neo_hookean", "saint_venant_kirchhoff", "linear"}},
        {"points_across_radius",
         KeyType::integer,
         std::int64_t{16},
         "",
         "material points across a radius, two in a grid cell: 16 is within 1 % in stress, 32 within 0.3 %",
         {4.0, 128.0}},
        {"mean_dilatation", KeyType::boolean, false, "",
         "take the pressure at the mean dilatation of each grid cell: for nu above 0.495"},
        {"penalty",
         KeyType::number,
         200.0,
         "E/(1 - nu^2) / grid spacing",
         "stiffness of contact: surfaces overlap by pressure / stiffness",
         {1.0, 1e5}},
        {"tolerance",
         KeyType::number,
         1e-5,
         "largest force of a node",
         "largest unbalanced force of a node that counts as equilibrium",
         {1e-10, 1e-2}},
        {"max_iterations",
         KeyType::integer,
         std::int64_t{200},
         "",
         "most iterations of Newton's method before a step is halved",
         {1.0, 1e5}},
        {"strain_step",
         KeyType::number,
         0.004,
         "",
         "largest motion of a wall, as a share of the box, after which an equilibrium is looked for",
         {1e-6, 0.1}},
    }};
    return table;
}

constexpr std::array refusals{
    Refusal{Feature::periodic_cell, "its contacts know only walls"},
    Refusal{Feature::clumps, "its grains are discs or ellipses"},
    Refusal{Feature::friction, "it finds equilibria of frictionless grains"},
    Refusal{Feature::wall_friction, "it finds equilibria of frictionless grains"},
    Refusal{Feature::cohesion, "its surfaces only repel each other"},
    Refusal{Feature::driven_grains, "its grains are deformable"},
};

std::unique_ptr<Solver> make(const Scenario& scenario, const Packing& packing) {
    refuse(scenario, packing, "mpm", refusals);
    return std::make_unique<MpmSolver>(scenario, packing);
}

}  // namespace

MpmSettings settings_of(const Scenario& scenario) {
    const auto given = scenario.method_settings.find("mpm");
    const Settings settings = given == scenario.method_settings.end() ? Settings(keys()) : given->second;
    for (const KeyFault& fault : faults_of(settings))
        throw InputError(fmt::format("mpm.{} {}", fault.key, fault.message));
    MpmSettings s;
    s.law = law_named(settings.text("law"));
    s.cells = static_cast<int>(settings.integer("points_across_radius")) / points_per_cell;
    s.strain_step = settings.number("strain_step");
    s.equilibrium.tolerance = settings.number("tolerance");
    s.equilibrium.most_iterations = static_cast<int>(settings.integer("max_iterations"));
    s.equilibrium.penalty = settings.number("penalty");
    s.equilibrium.mean_dilatation = settings.boolean("mean_dilatation");
    return s;
}

const Method& method() {
    static const Method row{"mpm",   "material points: resolved grains, the reference of the others",
                            &keys,   &make,
                            "",      &faults_of,
                            refusals};
    return row;
}

}  // namespace softgrain::mpm
