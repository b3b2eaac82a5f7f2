#pragma once
// The one seam between the time loop and a method.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/box.hpp"
#include "common/checkpoint.hpp"
#include "common/grain_view.hpp"
#include "common/packing/packing.hpp"
#include "common/refusals.hpp"
#include "common/scenario.hpp"

namespace softgrain {

/// A method's state and equations. The same bits for any number of threads.
class Solver {
  public:
    virtual ~Solver() = default;

    virtual double stable_time_step() const = 0;

    /// One step of `dt` while the walls move as told. Throws DivergedError. A step that takes long may throw
    /// StopAsked; the state is then that before the step.
    virtual void advance(const WallMotion& walls, double dt) = 0;

    /// The state after the last step. Fills at least what `need` asks for.
    virtual GrainView view(Need need) = 0;

    /// By grains on walls, mean over the last step if the method has impulses [N]. Cheap: asked at every
    /// step.
    virtual const std::array<Vec2, 4>& wall_force() const = 0;

    /// Love-Weber stress of a periodic cell, (1/A) sum of -force on i (x) branch from i to j, compression
    /// positive, mean over the last step if the method has impulses [N/m]. Cheap: asked at every step. Never
    /// called for a box with walls; throws std::logic_error if the method has no periodic cell.
    virtual Mat2 cell_stress() const;

    /// Stress that sets the scale of this grain material [N/m]: E, or `F0/<a0>` for an aggregate.
    virtual double stress_scale() const = 0;

    /// Why the method can no longer be trusted in its present state, if so; the loop then ends the run in
    /// good order.
    virtual std::optional<std::string> outside_validity() const { return std::nullopt; }

    /// Throws DivergedError if any part of the state is not finite.
    virtual void check_finite() const = 0;

    virtual void save(Checkpoint& to) const = 0;
    /// Restores a state saved by a solver made from the same scenario and packing.
    virtual void load(const Checkpoint& from) = 0;
};

/// A row of the table of methods.
struct Method {
    std::string_view name;
    std::string_view title;              ///< one line for `softgrain list`
    std::span<const KeySpec> (*keys)();  ///< its scenario table
    /// May throw StopAsked.
    std::unique_ptr<Solver> (*make)(const Scenario&, const Packing&);
    std::string_view not_given;  ///< history columns it leaves as nan, comma separated
    std::vector<KeyFault> (*faults)(const Settings&) = nullptr;  ///< of a scenario table, if it looks for any
    std::span<const Refusal> refusals = {};                      ///< what it does not have; make() refuses it
    double at_rest = packing_at_rest;  ///< unbalanced force that counts as rest after a change of stress
    /// Of stages that name no rate: the cheapest with nearly the least error of `softgrain bench error`.
    double inertial_number = 1e-2;
};

}  // namespace softgrain
