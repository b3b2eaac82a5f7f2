#pragma once
// A scenario is plain data: what is compacted, how, and what is written. It knows no method.
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/box.hpp"
#include "common/settings.hpp"

namespace softgrain {

/// Isotropic linear elastic grain material, plane strain. 2D stress is [N/m].
struct Material {
    double youngs_modulus = 1.0;  ///< E [N/m]
    double poisson_ratio = 0.3;   ///< nu, 0 to 0.5
    double density = 1.0;         ///< rho [kg/m^2]
    double friction = 0.0;        ///< Coulomb coefficient between grains; walls are frictionless
};

enum class SizeLaw { gaussian, fractal, uniform_volume, single };

/// Where the initial discs come from: a file of x,y,r or a generator.
struct PackingSpec {
    std::optional<std::filesystem::path> path;  ///< CSV of x,y,r [m]
    SizeLaw size_law = SizeLaw::gaussian;
    int count = 50;
    double radius_mean = 1.0;       ///< [m] gaussian, single
    double radius_deviation = 0.2;  ///< [m] gaussian
    double radius_min = 0.667;      ///< [m] cut-off
    double radius_max = 1.333;      ///< [m]
    double fractal_dimension = 2.0;
    /// Undeformed packing fraction to stop at; without it the packing is brought to its jamming point.
    std::optional<double> packing_fraction;
};

/// Given with a packing file; for a generated packing both set the aspect ratio and the final scale.
struct BoxSpec {
    std::optional<double> width, height;  ///< [m]
};

enum class LoadingKind { isotropic, oedometric, hold };

/// One loading stage. The first of its `until_...` that is reached ends it.
struct LoadingStage {
    LoadingKind kind = LoadingKind::isotropic;
    Wall wall = Wall::right;  ///< the moving wall of an oedometric stage
    std::optional<double>
        until_strain;  ///< engineering strain 1 - L/L0 along the loading axis, L0 of the run's start
    std::optional<double> until_packing_fraction;
    std::optional<double> until_packing_fraction_undeformed;
    std::optional<double> until_stress;  ///< mean wall stress [N/m]
    std::optional<double> duration;      ///< [s], for `hold`
    std::optional<double> strain_rate;   ///< d(1 - L/L0)/dt [1/s]
    std::optional<double>
        inertial_number;  ///< rate = I / (d sqrt(rho / p)), p = max(wall stress, 1e-3 stress scale)
};

struct Sampling {
    double strain_interval = 0.002;  ///< between two rows of the history
    double average_window =
        0.25;             ///< share of the interval, before a sample, over which wall forces are averaged
    int frame_every = 5;  ///< a VTK frame at every n-th sample
    bool outlines = true;
    bool contacts = true;
};

struct Scenario {
    std::string title;
    std::uint64_t seed = 1;
    Material material;
    PackingSpec packing;
    BoxSpec box;
    std::vector<LoadingStage> loading;
    Sampling sampling;
    std::map<std::string, Settings, std::less<>> method_settings;  ///< by method name
    std::filesystem::path source;                                  ///< file it was read from, for messages
};

}  // namespace softgrain
