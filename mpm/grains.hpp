#pragma once
// The deformable grains: what they are made of, and where their nodes are.
#include <memory>
#include <vector>

#include "mpm/disc/dissection.hpp"
#include "mpm/disc/reference_disc.hpp"
#include "mpm/disc/stiffness_pattern.hpp"
#include "mpm/laws/grain_law.hpp"

namespace softgrain::mpm {

/// What is the same at all times of one grain.
struct Grain {
    const GrainLaw* law;
    Mat2 frame;          ///< from the unit disc to the undeformed grain [m]
    Mat2 inverse_frame;  ///< [1/m]
    double area;         ///< undeformed area / area of the unit disc [m^2]
    double radius;       ///< of the disc of its area [m]
    double density;      ///< [kg/m^2]
    double modulus;      ///< E/(1 - nu^2) [N/m]

    double compliance() const { return radius / modulus; }
};

/// Spring of two surfaces, by their length in the undeformed grain [N/m^2]: `penalty` times the modulus over
/// the grid spacing, mean of both grains.
inline double contact_stiffness(double penalty, double spacing, double compliance, double other_compliance) {
    return 2.0 * penalty / (spacing * (compliance + other_compliance));
}

/// All grains share one reference disc. Nodes of grain g are [g * nodes, (g + 1) * nodes).
struct Grains {
    std::shared_ptr<const ReferenceDisc> disc;
    std::shared_ptr<const StiffnessPattern> pattern;
    std::shared_ptr<const Dissection> dissection;
    std::vector<std::unique_ptr<GrainLaw>> law;  ///< by class
    std::vector<Grain> grain;
    bool threads = false;  ///< whether loops over grains, contacts and fronts are shared among threads

    std::size_t size() const { return grain.size(); }
    std::size_t nodes() const { return disc->nodes(); }
    std::size_t all_nodes() const { return size() * nodes(); }
    std::size_t points() const { return disc->points(); }
    /// Integral of density times N [kg].
    double mass_of_node(std::size_t g, std::size_t node) const {
        return grain[g].density * grain[g].area * disc->integral[node];
    }

    template <class T>
    std::span<T> of(std::vector<T>& values, std::size_t g) const {
        return {values.data() + g * nodes(), nodes()};
    }
    template <class T>
    std::span<const T> of(const std::vector<T>& values, std::size_t g) const {
        return {values.data() + g * nodes(), nodes()};
    }
    /// Of values by material points, or of none.
    template <class T>
    std::span<T> of_points(std::vector<T>& values, std::size_t g) const {
        return values.empty() ? std::span<T>{} : std::span<T>{values.data() + g * points(), points()};
    }
    template <class T>
    std::span<const T> of_points(const std::vector<T>& values, std::size_t g) const {
        return values.empty() ? std::span<const T>{}
                              : std::span<const T>{values.data() + g * points(), points()};
    }
};

}  // namespace softgrain::mpm
