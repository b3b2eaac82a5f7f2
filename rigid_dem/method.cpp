#include "rigid_dem/method.hpp"

#include "common/refusals.hpp"
#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {
namespace {

constexpr std::array refusals{
    Refusal{Feature::ellipses, "its grains are discs"},
    Refusal{Feature::yield_stress, "its contacts are elastic"},
};

}  // namespace

const Method& method() {
    static const Method row{
        .name = "rigid_dem",
        .title =
            "rigid discs, elastic contacts with damping, friction, rolling resistance, bonds (Cundall and "
            "Strack 1979)",
        .keys = keys,
        .make = [](const Scenario& scenario, const Packing& packing) -> std::unique_ptr<Solver> {
            refuse(scenario, packing, "rigid_dem", refusals);
            return std::make_unique<RigidDem>(scenario, packing);
        },
        .not_given = "contact_penetration, contact_sweeps, unconverged_steps, fragments",
        .faults = faults,
        .refusals = refusals};
    return row;
}

}  // namespace softgrain::rigid_dem
