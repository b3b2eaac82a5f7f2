#pragma once
// Coulomb friction of surface points against other grains and walls.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "common/checkpoint.hpp"
#include "mpm/contact/contacts.hpp"

namespace softgrain::mpm {

/// A surface point that rubs: its force is start + stiffness * slip, at most `most` either way.
struct Slider {
    double most = 0.0;       ///< friction coefficient times normal force [N]
    double stiffness = 0.0;  ///< along the surface, 0: no friction [N/m]
    double coefficient = 0.0;
    double start = 0.0;  ///< when the step began [N]
    double trial = 0.0;  ///< start + stiffness * slip [N]

    /// Against the slip of i along the tangent [N].
    double force() const { return std::clamp(trial, -most, most); }
    /// Energy of its pull, sliding included [J].
    double energy_at(double pull) const {
        const double size = std::abs(pull);
        return (size <= most ? 0.5 * size * size : most * (size - 0.5 * most)) / stiffness;
    }
};

/// What a spring keeps from step to step.
struct FrictionSpring {
    int i, point, j;
    double force;      ///< [N]
    double stiffness;  ///< [N/m]
};

/// Springs along the surfaces, as stiff as those across, that slide where they pull with more than the
/// coefficient times the normal force. Slip is that of the two pieces of matter that now touch, since the
/// step began, along the tangent where they touch. Normal force, place and tangent are those of the last
/// lag(): for them friction has an energy (Li et al. 2020, incremental potential contact), and a solution
/// is found when they no longer change. bound() puts in normal forces that are foreseen.
class Friction {
  public:
    /// Coefficients; both 0: no friction, and nothing is done.
    Friction(const Grains& grains, double between_grains, double at_walls);

    bool exists() const { return between_grains_ > 0.0 || at_walls_ > 0.0; }
    /// A step begins: slip is measured from these surfaces on.
    void begin(const Surfaces& surfaces);
    /// Takes normal forces, places and tangents as they are.
    void lag(const Contacts& contacts);
    /// Other largest forces than those of the lag [points].
    void bound(std::span<const double> most);
    /// Energy since begin() [J]; adds its derivative to `force` [all nodes].
    double evaluate(const Surfaces& surfaces, std::span<Vec2> force);
    /// The step of the last evaluate() is made. Returns what sliding has dissipated [J].
    double end();

    /// By the points of the contacts that lag() was called for; empty without friction.
    std::span<const Slider> sliders() const { return slider_; }
    /// Of grains on walls [N].
    const std::array<Vec2, 4>& wall_force() const { return wall_force_; }
    /// In springs, since the last end() [J].
    double stored() const;

    void save(Checkpoint& to) const;
    /// Throws InputError if what was saved is broken.
    void load(const Checkpoint& from);

  private:
    double coefficient(int j) const { return j < 0 ? at_walls_ : between_grains_; }
    double force_of_spring(const PointContact& c) const;
    Vec2 apart(const PointContact& c, const Surfaces& surfaces) const;

    const Grains& grains_;
    double between_grains_, at_walls_;
    Surfaces from_;
    std::vector<PointContact> contact_;  ///< of the last lag()
    std::vector<Slider> slider_;
    std::array<Vec2, 4> wall_force_;
    std::vector<FrictionSpring> springs_;  ///< sorted by (i, point, j)
};

}  // namespace softgrain::mpm
