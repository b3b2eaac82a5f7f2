#pragma once
// A scenario is plain data: what is compacted, how, and what is written. It knows no method.
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/box.hpp"
#include "common/disc.hpp"
#include "common/settings.hpp"

namespace softgrain {

/// Isotropic grain material, plane strain. 2D stress is [N/m].
struct Material {
    double youngs_modulus = 1.0;              ///< E [N/m]
    double poisson_ratio = 0.3;               ///< nu, 0 to 0.5
    double density = 1.0;                     ///< rho [kg/m^2]
    double friction = 0.0;                    ///< Coulomb coefficient between grains
    double wall_friction = 0.0;               ///< Coulomb coefficient between grains and walls
    double cohesion = 0.0;                    ///< largest normal adhesion per length of contact [N/m]
    std::optional<double> yield_stress = {};  ///< elasto-plastic grains [N/m]
};

/// A share of the grains with their own material and shape. What holds between grains (friction, wall
/// friction, cohesion) is that of the scenario.
struct GrainClass {
    std::string name;
    double share = 1.0;            ///< by number, relative to the sum over the classes
    Material material;             ///< complete
    double aspect_ratio = 1.0;     ///< of undeformed grains: discs or ellipses of the same area, 1 to 3
    std::vector<Disc> clump = {};  ///< of rigid clusters of discs of the same area, in any unit; empty: none
};

enum class SizeLaw { gaussian, fractal, uniform_volume, single, uniform, two_sizes };

/// growth: of the radii from the inside, from random places to jamming; random_sequential: at random places;
/// compaction: by walls, from the outside; geometric: each disc against two others;
/// deposition: under gravity.
enum class Generator { growth, random_sequential, compaction, geometric, deposition };

/// Part of the box that is filled at the start: a disc, or a rectangle.
struct PackingRegion {
    Vec2 center = Vec2::Zero();  ///< from the lower left corner of the box [m]
    double radius = 0.0;         ///< of a disc [m]; 0: a rectangle
    Vec2 size = Vec2::Zero();    ///< width and height of a rectangle [m]
};

/// Where the initial discs come from: a file of x,y,r or a generator.
struct PackingSpec {
    std::optional<std::filesystem::path> path;  ///< CSV of x,y,r [m]
    Generator generator = Generator::growth;
    SizeLaw size_law = SizeLaw::gaussian;
    int count = 50;
    double radius_mean = 1.0;       ///< [m] gaussian, single
    double radius_deviation = 0.2;  ///< [m] gaussian
    double radius_min = 0.667;      ///< [m] cut-off
    double radius_max = 1.333;      ///< [m]
    double fractal_dimension = 2.0;
    double small_share = 0.5;  ///< of the grains by number, two_sizes
    /// Undeformed packing fraction to stop at; without it the packing is brought to its jamming point.
    std::optional<double> packing_fraction;
    std::optional<PackingRegion>
        region;  ///< with random_sequential and a box of given size, in which radii stay
};

/// Discs that move as they are told and that no force moves: a ring that may turn about its middle, or a row.
struct DrivenGrains {
    bool ring = false;
    double disc_radius = 1.0;                     ///< [m]
    double spacing = 1.0;                         ///< largest, between neighbours [disc diameters]
    Vec2 center = Vec2::Zero();                   ///< of a ring [m]
    double radius = 0.0;                          ///< of the circle through its discs' centres [m]
    double spin = 0.0;                            ///< of a ring, counter-clockwise [1/s]
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< centres of a row's first and last disc [m]
    Vec2 velocity = Vec2::Zero();                 ///< of a row [m/s]
};

/// Given with a packing file; for a generated packing both set the aspect ratio and the final scale.
struct BoxSpec {
    std::optional<double> width, height;  ///< [m]
    bool periodic = false;                ///< a periodic cell instead of walls
    Vec2 gravity = Vec2::Zero();          ///< acceleration of free grains, walls only [m/s^2]
};

/// What moves (common/stage_plan.hpp). shear and gradient are for a periodic cell only.
enum class LoadingKind {
    isotropic,   ///< both axes by rate
    oedometric,  ///< one wall by rate
    hold,        ///< nothing moves
    shear,       ///< the tilt by rate; the height stands, or follows normal_stress
    gradient,    ///< any velocity gradient
    uniaxial,    ///< one axis by rate, the other stands
    biaxial,     ///< one axis by rate, the other follows lateral_stress
    stress,      ///< both axes, or one, to a stress
    probe,       ///< a small step of stress or strain in one direction of the (xx, yy) plane
    repeat,      ///< stages before it once more
};

/// One loading stage. The first of its ends that is reached ends it: any `until_...`, the duration, and of
/// `stress` and `probe` what they go to. Stress is compression positive.
struct LoadingStage {
    LoadingKind kind = LoadingKind::isotropic;
    Wall wall = Wall::right;               ///< the moving wall of an oedometric stage
    int axis = 1;                          ///< that a uniaxial or biaxial stage loads: 0 x, 1 y
    std::optional<double> lateral_stress;  ///< of the other axis of a biaxial stage [N/m]
    std::optional<double> normal_stress;   ///< yy of a shear whose height is free [N/m]
    std::optional<double> stress_xx,
        stress_yy;            ///< that a `stress` stage goes to; none: the axis stands [N/m]
    double tolerance = 0.01;  ///< of `stress` and `probe`, relative: the stress that counts as reached
    double direction = 0.0;   ///< of a probe: 0 is +xx, 90 is +yy [degrees]
    std::optional<double> stress_amplitude;  ///< of a probe [N/m]
    std::optional<double> strain_amplitude;  ///< of a probe
    int stages = 1, times = 1;               ///< of `repeat`: how many stages before it, how often again

    std::optional<double>
        until_strain;  ///< engineering strain 1 - L/L0 along the loading axis, L0 of the run's start
    std::optional<double> until_packing_fraction;
    std::optional<double> until_packing_fraction_undeformed;
    std::optional<double> until_shear;   ///< tilt / height of the cell, for `shear`
    std::optional<double> until_stress;  ///< mean stress of the walls, or of the cell [N/m]
    std::optional<double> until_stress_xx, until_stress_yy;  ///< [N/m]
    std::optional<double>
        until_stress_ratio;                  ///< q / p: half the difference of the principal stresses / mean
    std::optional<double> until_unbalanced;  ///< at or below; with `stress` and `probe` beside their target
    std::optional<double> duration;          ///< [s]
    std::optional<double> strain_rate;       ///< d(1 - L/L0)/dt, or d(tilt / height)/dt of a shear [1/s]
    std::optional<double> inertial_number;   ///< rate = I / (d sqrt(rho / p)), see StageDriver::rate
    bool reverse = false;                    ///< the other way (unloading): ends are then reached from above
    double gradient_xx = 0.0, gradient_xy = 0.0,
           gradient_yy = 0.0;  ///< of `gradient`: velocity d/dx, d/dy [1/s]

    /// Goes to a stress by servo-control: `stress`, and `probe` by stress.
    bool seeks_stress() const {
        return kind == LoadingKind::stress || (kind == LoadingKind::probe && stress_amplitude);
    }
    /// Moves at a rate: strain_rate or inertial_number, or the method's own if neither is given.
    bool has_rate() const {
        return kind != LoadingKind::hold && kind != LoadingKind::gradient && kind != LoadingKind::repeat;
    }
};

/// Unbalanced force at which a packing that has come to its stress is at rest, if neither the stage nor the
/// method says another.
inline constexpr double packing_at_rest = 0.01;

/// Places in `loading` of the stages in the order in which they run: every `repeat` is replaced by what it
/// repeats.
std::vector<std::size_t> stage_order(const std::vector<LoadingStage>& loading);

struct Sampling {
    double strain_interval = 0.002;  ///< between two rows of the history
    double average_window =
        0.25;             ///< share of the interval, before a sample, over which stresses are averaged
    int frame_every = 5;  ///< a VTK frame at every n-th sample
    bool outlines = true;
    bool contacts = true;
    bool parts = false;                      ///< what grains are made of, of the methods that have such parts
    std::vector<std::string> measures = {};  ///< written at every frame, see MeasureWriter
    std::optional<double> time_interval =
        {};  ///< between two rows of a hold [s]; without it a tenth of the hold
};

/// What is looked at at every sample (common/watch.hpp). A limit without a value is not watched.
struct Watch {
    bool stop = false;  ///< a broken limit ends the run (exit 3); else it is written as a warning
    std::optional<double> energy_residual = {};  ///< largest |energy_residual| / energy that was put in
    std::optional<double> momentum =
        {};  ///< largest |momentum - impulses| / sum of |impulses|, since the last sample
    std::optional<double> penetration = {};    ///< largest contact_penetration / mean diameter
    std::optional<double> unconverged = {};    ///< largest share of the steps since the last sample
    std::optional<double> lost_contacts = {};  ///< most pairs of grains that must touch and have no contact
};

struct Scenario {
    std::string title;
    std::uint64_t seed = 1;
    Material material;
    std::vector<GrainClass> classes;  ///< empty: one class of discs, made of `material`
    PackingSpec packing;
    std::vector<DrivenGrains> driven;
    BoxSpec box;
    std::vector<LoadingStage> loading;
    Sampling sampling;
    Watch watch;
    std::map<std::string, Settings, std::less<>> method_settings;  ///< by method name
    std::filesystem::path source;                                  ///< file it was read from, for messages

    std::size_t class_count() const { return classes.empty() ? 1 : classes.size(); }
    const Material& material_of(std::size_t grain_class) const {
        return classes.empty() ? material : classes.at(grain_class).material;
    }
    /// True if a class of ellipses is among the classes.
    bool has_ellipses() const;
    /// True if a class of clumps is among the classes.
    bool has_clumps() const;
};

}  // namespace softgrain
