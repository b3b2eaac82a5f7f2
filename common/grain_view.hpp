#pragma once
// The common tongue: what every method tells about its grains. Observables and writers read only this.
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "common/box.hpp"
#include "common/vec.hpp"

namespace softgrain {

/// What a reader is going to look at; the rest need not be computed.
enum class Need : std::uint32_t {
    base = 0,        ///< centroid, velocity, mass, box, wall_force, energy
    area = 1U << 0,  ///< area, covered_area
    contacts = 1U << 1,
    stress = 1U << 2,
    outlines = 1U << 3,
    fields = 1U << 4,
    all = (1U << 5) - 1,  ///< all of the above
    parts = 1U << 5,      ///< what grains are made of: only for who says so
};
constexpr Need operator|(Need a, Need b) {
    return static_cast<Need>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr bool wants(Need all, Need one) {
    return (static_cast<std::uint32_t>(all) & static_cast<std::uint32_t>(one)) != 0;
}

/// A pair of touching grains, or a grain touching a wall.
struct GrainContact {
    int i;          ///< grain
    int j;          ///< second grain (j > i), or -1 - wall
    Vec2 point;     ///< representative point, near grain i if the pair meets across a periodic cell [m]
    Vec2 normal;    ///< unit, out of i
    Vec2 force;     ///< on i [N]
    double length;  ///< contact length [m]; 0 if the method has point contacts

    bool with_wall() const { return j < 0; }
    int wall() const { return -1 - j; }
    double normal_force() const { return -force.dot(normal); }  ///< compression positive [N]
};

/// Running energies since the start of the run [J per unit thickness]. Zero for mechanisms a method does not
/// have.
struct EnergyLedger {
    double kinetic =
        0.0;  ///< of free grains; of the motion against the flow of a periodic cell, if there is one
    double elastic = 0.0;  ///< stored, recoverable
    double external_work =
        0.0;                ///< done on the grains by walls, driven grains, the deforming cell and gravity
    double damping = 0.0;   ///< dissipated by viscous terms
    double friction = 0.0;  ///< dissipated by sliding
    double impact = 0.0;    ///< dissipated by inelastic shocks
    double plastic = 0.0;   ///< dissipated by plastic flow
    double adhesion = 0.0;  ///< dissipated where cohesion pulls less hard than it was overcome

    double dissipated() const { return damping + friction + impact + plastic + adhesion; }
};

/// A method's own quantity per grain or part, written as it is.
struct Field {
    std::string_view name, unit;
    int components;                  ///< 1 (scalar), 2 (vector) or 4 (tensor xx, xy, yx, yy)
    std::span<const double> values;  ///< [n * components]
};

/// Two parts that press on each other, or a part that presses on a wall.
struct PartContact {
    int i;                    ///< part
    int j;                    ///< second part (j > i), or -1 - wall
    double normal_force;      ///< compression positive [N]
    double tangential_force;  ///< on i, along the normal out of i turned by +90 degrees [N]

    bool with_wall() const { return j < 0; }
    int wall() const { return -1 - j; }
};

/// What grains are made of: the discs of an aggregate, the material points of a continuum. Empty if a
/// method's grains have no parts.
struct PartView {
    std::span<const Vec2> position;         ///< [p] may lie outside a periodic cell [m]
    std::span<const Vec2> reference;        ///< [p] at the start of the run [m]
    std::span<const double> radius;         ///< [p] of the part, or of a disc of its area [m]
    std::span<const int> grain;             ///< [p] the grain it belongs to
    std::span<const PartContact> contacts;  ///< that carry force, sorted by (i, j), walls (j < 0) first
    std::vector<Field> fields;              ///< the method's own, per part

    std::size_t size() const { return position.size(); }
};

/// How a method that solves for its contacts fares; nan for all others.
struct ContactReport {
    double penetration =
        std::numeric_limits<double>::quiet_NaN();              ///< deepest overlap before the last step [m]
    double sweeps = std::numeric_limits<double>::quiet_NaN();  ///< over the contacts, in the last step
    double unconverged_steps = std::numeric_limits<double>::quiet_NaN();  ///< since the start
};

/// Non-owning view of a solver's state; valid until the solver advances. Stress is compression positive.
struct GrainView {
    double time = 0.0;
    Box box;                                 ///< as the loop moved it: the tilt of a cell is not reduced
    std::span<const Vec2> centroid;          ///< [n] may lie outside a periodic cell [m]
    std::span<const Vec2> velocity;          ///< [n] [m/s]
    std::span<const double> mass;            ///< [n] [kg]
    std::size_t driven = 0;                  ///< of the grains the last ones, which move as they are told
    Vec2 gravity = Vec2::Zero();             ///< weight of a grain: its mass times this [m/s^2]
    std::span<const double> reference_area;  ///< [n] undeformed [m^2]
    std::array<Vec2, 4> wall_force{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(),
                                   Vec2::Zero()};  ///< by grains on walls, zero in a periodic cell [N]
    EnergyLedger energy;

    std::span<const double> area;  ///< [n] current area of each grain [m^2]
    double covered_area = 0.0;     ///< area covered by free grains, overlaps counted once [m^2]

    /// Sorted by (i, j), walls (j < 0) first; a pair stands there once for each place where it touches.
    std::span<const GrainContact> contacts;

    std::span<const Mat2> stress;  ///< [n] mean Cauchy stress of each grain [N/m]

    std::span<const int> outline_offset;  ///< [n + 1] into outline_point
    std::span<const Vec2> outline_point;  ///< closed polygons, counter-clockwise [m]

    std::vector<Field> fields;

    PartView parts;

    ContactReport contact_report;
    double fragments =
        std::numeric_limits<double>::quiet_NaN();  ///< that all grains have come to, if the method knows

    std::size_t size() const { return centroid.size(); }
    /// Grains that forces move; they come first.
    std::size_t free_size() const { return centroid.size() - driven; }
    /// With a wall, or a driven grain that is like one.
    bool at_boundary(const GrainContact& c) const {
        return c.with_wall() || static_cast<std::size_t>(c.j) >= free_size();
    }
};

}  // namespace softgrain
