#include "common/io/scenario_schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/packing/generators.hpp"
#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain::scenario_io {
namespace {

using enum KeyType;
constexpr Range fraction{0.0, 1.0, true, true};

template <std::size_t n>
std::vector<std::string_view> words(const std::array<std::string_view, n>& names) {
    return {names.begin(), names.end()};
}

const std::vector<KeySpec> top_keys{
    {"title", text, Value(std::string()), "", "one line that names the scenario"},
};

const std::vector<KeySpec> random_keys{
    {"seed", integer, Value(std::int64_t{1}), "", "seed of sizes, placement and inner structure",
     not_negative},
};

const std::vector<KeySpec> material_keys{
    {"youngs_modulus", number, Material{}.youngs_modulus, "N/m", "Young's modulus E of a grain", positive},
    {"poisson_ratio", number, Material{}.poisson_ratio, "", "Poisson's ratio, plane strain", Range{0.0, 0.5}},
    {"density", number, Material{}.density, "kg/m^2", "mass per area", positive},
    {"friction", number, Material{}.friction, "", "Coulomb coefficient between grains", not_negative},
    {"wall_friction", number, Material{}.wall_friction, "", "Coulomb coefficient between grains and walls",
     not_negative},
    {"cohesion", number, Material{}.cohesion, "N/m", "largest normal adhesion per length of contact",
     not_negative},
    {"yield_stress", number, Value(), "N/m", "of elasto-plastic grains; elastic if not given", positive},
};

const std::vector<KeySpec> class_keys{
    {"name", text, Value(std::string()), "", "for people"},
    {"share", number, GrainClass{}.share, "", "of the grains by number, relative to the sum over the classes",
     positive},
    {"youngs_modulus", number, Value(), "N/m", "that of [material] if not given", positive},
    {"poisson_ratio", number, Value(), "", "that of [material] if not given", Range{0.0, 0.5}},
    {"density", number, Value(), "kg/m^2", "that of [material] if not given", positive},
    {"yield_stress", number, Value(), "N/m", "that of [material] if not given", positive},
    {"aspect_ratio", number, GrainClass{}.aspect_ratio, "",
     "long / short axis of ellipses of the area of the disc; a generator puts each at a random angle inside "
     "a disc of its long axis, and packs those discs",
     Range{1.0, most_elongated}},
    {"clump", text, Value(), "",
     "rigid clusters of discs of the area of the disc, in any unit: \"x y r, x y r\"; put at a random angle "
     "inside "
     "the disc around them, as ellipses"},
    {"clump_discs", integer, Value(), "", "instead of clump: this many equal discs in a line",
     Range{2.0, static_cast<double>(most_discs_of_a_clump)}},
    {"clump_elongation", number, Value(), "",
     "length / width of the line of clump_discs; by itself they lie a radius apart", positive},
};

const std::vector<KeySpec> packing_keys{
    {"path", text, Value(), "",
     "CSV file of x,y,r; from the scenario's folder; needs box.width and box.height"},
    {"generator", text, Value(std::string(generator_names[0])), "",
     "growth of the radii from the inside, to jamming; compaction by walls from the outside, to jamming; "
     "random_sequential: the largest first, at random places; geometric: each against two others, from the "
     "middle outwards",
     any_number, words(generator_names)},
    {"size_law", text, Value(std::string(size_law_names[0])), "",
     "distribution of the grain radii: uniform by number, uniform_volume by area", any_number,
     words(size_law_names)},
    {"count", integer, Value(std::int64_t{PackingSpec{}.count}), "", "number of grains", Range{1.0, 1e6}},
    {"radius_mean", number, PackingSpec{}.radius_mean, "m",
     "mean of gaussian before the cut; radius of single", positive},
    {"radius_deviation", number, PackingSpec{}.radius_deviation, "m", "standard deviation of gaussian",
     not_negative},
    {"radius_min", number, PackingSpec{}.radius_min, "m", "smallest radius (all laws but single)", positive},
    {"radius_max", number, PackingSpec{}.radius_max, "m", "largest radius (all laws but single)", positive},
    {"fractal_dimension", number, PackingSpec{}.fractal_dimension, "", "D of fractal: N(>r) ~ r^-D",
     positive},
    {"small_share", number, PackingSpec{}.small_share, "",
     "of two_sizes: grains of radius_min / all grains, by number; the rest are of radius_max", fraction},
    {"packing_fraction", number, Value(), "",
     "stop at this undeformed packing fraction; without it growth and compaction stop at the jamming point "
     "(of ellipses: "
     "of "
     "the discs around them)",
     fraction},
    {"region", text, Value(), "",
     "part of the box that random_sequential fills; radii then stay as they are and the box is box.width by "
     "box.height",
     any_number, words(region_names)},
    {"region_x", number, Value(), "m", "middle of the region; of the box if not given"},
    {"region_y", number, Value(), "m", "middle of the region; of the box if not given"},
    {"region_radius", number, Value(), "m", "of a disc", positive},
    {"region_width", number, Value(), "m", "of a rectangle", positive},
    {"region_height", number, Value(), "m", "of a rectangle", positive},
};

const std::vector<KeySpec> driven_keys{
    {"kind", text, Value(std::string(driven_kind_names[0])), "",
     "ring: about a centre, with a spin; row: from one point to another, with a velocity", any_number,
     words(driven_kind_names)},
    {"disc_radius", number, DrivenGrains{}.disc_radius, "m", "of each disc", positive},
    {"spacing", number, DrivenGrains{}.spacing, "disc diameters",
     "largest distance of neighbours; they do not press on each other", Range{0.0, 10.0, true}},
    {"center_x", number, Value(), "m", "of a ring, from the box's lower left corner"},
    {"center_y", number, Value(), "m", "of a ring, from the box's lower left corner"},
    {"radius", number, Value(), "m", "of a ring: of the circle through its discs' centres", positive},
    {"spin", number, Value(), "1/s", "of a ring, counter-clockwise; 0 if not given"},
    {"from_x", number, Value(), "m", "centre of a row's first disc"},
    {"from_y", number, Value(), "m", "centre of a row's first disc"},
    {"to_x", number, Value(), "m", "centre of a row's last disc"},
    {"to_y", number, Value(), "m", "centre of a row's last disc"},
    {"velocity_x", number, Value(), "m/s", "of a row; 0 if not given"},
    {"velocity_y", number, Value(), "m/s", "of a row; 0 if not given"},
};

const std::vector<KeySpec> box_keys{
    {"width", number, Value(), "m", "of the box; with a generated packing it sets aspect ratio and scale",
     positive},
    {"height", number, Value(), "m", "of the box", positive},
    {"periodic", boolean, Value(false), "", "a periodic cell instead of walls"},
    {"gravity_x", number, Value(0.0), "m/s^2", "body force / mass, of a box with walls"},
    {"gravity_y", number, Value(0.0), "m/s^2", "body force / mass, of a box with walls; negative: downwards"},
};

const std::vector<KeySpec> loading_keys{
    {"kind", text, Value(std::string(loading_kind_names[0])), "",
     "by rate: all walls (isotropic), one wall (oedometric), both walls of an axis (uniaxial), the same with "
     "the other axis at constant stress (biaxial); nothing moves (hold); to a stress (stress, probe); what "
     "came before once more (repeat); of a periodic cell also simple shear or any velocity gradient",
     any_number, words(loading_kind_names)},
    {"wall", text, Value(), "", "moving wall or face, oedometric only", any_number, words(wall_names)},
    {"axis", text, Value(), "", "that a uniaxial or biaxial stage loads; y if not given", any_number,
     words(axis_names)},
    {"lateral_stress", number, Value(), "N/m", "kept on the other axis of a biaxial stage by servo-control",
     positive},
    {"normal_stress", number, Value(), "N/m",
     "kept on yy during a shear by servo-control of the height; without it the area is constant", positive},
    {"pressure", number, Value(), "N/m", "that a stress stage goes to: stress_xx and stress_yy in one",
     positive},
    {"stress_xx", number, Value(), "N/m", "that a stress stage goes to; the axis stands if not given",
     positive},
    {"stress_yy", number, Value(), "N/m", "that a stress stage goes to; the axis stands if not given",
     positive},
    {"tolerance", number, Value(), "",
     "stress that counts as reached, share of it (stress) or of the amplitude (probe); 0.01 if not given",
     Range{0.0, 1.0, true, true}},
    {"direction", number, Value(), "degrees", "of a probe in the plane of xx and yy: 0 is +xx, 90 is +yy",
     Range{-360.0, 360.0}},
    {"stress_amplitude", number, Value(), "N/m", "of a probe from the stress at which it begins", positive},
    {"strain_amplitude", number, Value(), "", "of a probe from the strain at which it begins",
     Range{0.0, 1.0, true, true}},
    {"stages", integer, Value(), "", "of a repeat: how many stages before it to run once more",
     Range{1.0, 1e4}},
    {"times", integer, Value(), "", "of a repeat: how often; once if not given", Range{1.0, 1e4}},
    {"until_strain", number, Value(), "", "end at this 1 - L/L0, L0 of the run's start",
     Range{-1.0, 1.0, false, true}},
    {"until_packing_fraction", number, Value(), "", "end at this covered area / box area", fraction},
    {"until_packing_fraction_undeformed", number, Value(), "", "end at this undeformed grain area / box area",
     positive},
    {"until_shear", number, Value(), "", "end at this tilt / height of the periodic cell, shear only",
     Range{-100.0, 100.0}},
    {"until_stress", number, Value(), "N/m", "end at this mean stress of the walls or the cell", positive},
    {"until_stress_xx", number, Value(), "N/m", "end at this stress_xx", positive},
    {"until_stress_yy", number, Value(), "N/m", "end at this stress_yy", positive},
    {"until_stress_ratio", number, Value(), "",
     "end at this q / p: half the difference of the principal stresses / mean stress", positive},
    {"until_unbalanced", number, Value(), "",
     "end at or below this unbalanced force (equilibrium); stress, and probe by stress, end at their target "
     "in equilibrium: 0.01 if not given, 1 for bpm whose impulses tremble",
     positive},
    {"duration", number, Value(), "s", "longest time of the stage; must be given for a hold or gradient",
     positive},
    {"strain_rate", number, Value(), "1/s",
     "d(1 - L/L0)/dt, d(tilt / height)/dt of a shear; the largest of stress and probe by stress", positive},
    {"inertial_number", number, Value(), "",
     "I = strain rate * d sqrt(rho / p), instead of strain_rate; p is the mean stress, at least 1e-3 of the "
     "grains' stress scale, or the stress that servo-control keeps. With neither the method's own is taken: "
     "1e-2, or 1e-3 for mpm",
     positive},
    {"reverse", boolean, Value(false), "",
     "move the other way (unload); every end is then reached from above"},
    {"gradient_xx", number, Value(), "1/s", "velocity gradient dvx/dx, gradient only; 0 if not given"},
    {"gradient_xy", number, Value(), "1/s", "velocity gradient dvx/dy, gradient only; 0 if not given"},
    {"gradient_yy", number, Value(), "1/s", "velocity gradient dvy/dy, gradient only; 0 if not given"},
};

const std::vector<KeySpec> sampling_keys{
    {"strain_interval", number, Sampling{}.strain_interval, "",
     "strain between two rows of the history; where a stage goes to a stress, largest strain rate times time",
     Range{0.0, 1.0, true, false}},
    {"time_interval", number, Value(), "s", "time between two rows of a hold; a tenth of it if not given",
     positive},
    {"average_window", number, Sampling{}.average_window, "",
     "share of the interval before a sample over which stresses are averaged", Range{0.0, 1.0}},
    {"frame_every", integer, Value(std::int64_t{Sampling{}.frame_every}), "", "samples for one VTK frame",
     Range{1.0, 1e9}},
    {"outlines", boolean, Value(Sampling{}.outlines), "", "write grain outlines"},
    {"contacts", boolean, Value(Sampling{}.contacts), "", "write contacts, of grains and of parts"},
    {"parts", boolean, Value(Sampling{}.parts), "",
     "write what grains are made of, such as the discs of bpm; a method without parts writes nothing more"},
    {"measures", text, Value(std::string()), "",
     "written at every frame as measures/<name>_<frame>.csv: names out of grains (centre, velocity, "
     "radius), forces (their distribution), "
     "chains "
     "(stress of grains and force chains), pair_correlation, tessellation (void ratio and strain since the "
     "last frame in triangles between centres), parted by commas"},
};

const std::vector<KeySpec> watch_keys{
    {"action", text, Value(std::string(watch_action_names[0])), "",
     "what a broken limit does: warn in history.csv, run.json and the report, or stop the run (exit code 3)",
     any_number, words(watch_action_names)},
    {"energy_residual", number, 0.5, "",
     "largest |energy_residual| / energy put in: initial energy and the largest |external_work|", positive},
    {"momentum", number, Value(), "",
     "largest |change of momentum - impulses of walls and weights| / sum of the |impulses|, since the last "
     "sample; of "
     "a box with walls, without driven grains, where grains move by their inertia and no global damping",
     positive},
    {"penetration", number, Value(), "", "largest contact_penetration / mean grain diameter (bpm, mpm)",
     positive},
    {"unconverged", number, 0.5, "", "largest share of unconverged steps since the last sample (bpm, mpm)",
     not_negative},
    {"lost_contacts", number, Value(), "",
     "most pairs of grains with no contact whose centroids are closer than 0.6 of the sum of their radii (of "
     "the "
     "discs within ellipses; not of clumps)",
     not_negative},
};

const std::array<TableSpec, 10> tables{{
    {"", "", top_keys},
    {"random", "Random numbers.", random_keys},
    {"material", "The grains' material, plane strain, per unit thickness.", material_keys},
    {"grain_class",
     "A share of the grains with its own material or shape; none: all grains are discs of [material].",
     class_keys, true},
    {"packing", "The initial grains: a file (path) or a generator (all other keys).", packing_keys},
    {"driven", "Discs that move as they are told, whatever pushes them; they come after the packing's.",
     driven_keys, true},
    {"box", "The container.", box_keys},
    {"loading", "A stage of the loading; the first `until_...` that is reached ends it, or its duration.",
     loading_keys, true},
    {"sampling", "What is written, and how often.", sampling_keys},
    {"watch", "Limits that are looked at at every sample.", watch_keys},
}};

}  // namespace

std::span<const TableSpec> core_tables() {
    return tables;
}

const TableSpec& core_table(std::string_view name) {
    for (const TableSpec& table : tables)
        if (table.name == name) return table;
    throw std::logic_error(fmt::format("no scenario table '{}'", name));
}

Generator generator_of(const Settings& packing) {
    const auto* name = std::find(generator_names.begin(), generator_names.end(), packing.text("generator"));
    return static_cast<Generator>(name - generator_names.begin());
}

std::string describe(const Range& range) {
    std::string out;
    if (std::isfinite(range.min)) out = fmt::format("{} {}", range.open_min ? ">" : ">=", range.min);
    if (std::isfinite(range.max))
        out += fmt::format("{}{} {}", out.empty() ? "" : " and ", range.open_max ? "<" : "<=", range.max);
    return out;
}

std::string_view describe(KeyType type) {
    switch (type) {
        case boolean:
            return "true or false";
        case integer:
            return "an integer";
        case number:
            return "a number";
        case text:
            break;
    }
    return "a text";
}

std::string join(std::span<const std::string_view> list) {
    return fmt::format("{}", fmt::join(list, ", "));
}

}  // namespace softgrain::scenario_io
