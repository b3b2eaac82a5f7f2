#pragma once
// Scenes that several tests of rigid DEM share.
#include <functional>

#include "rigid_dem/method.hpp"
#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {

/// E = 1, restitution 1, safety 0.5, overlap_limit 10, changed as told.
inline Scenario scenario_with(const std::function<void(Scenario&, Settings&)>& change) {
    Scenario s;
    Settings table(method().keys());
    table.set("restitution", 1.0);
    table.set("safety", 0.5);
    table.set("overlap_limit", 10.0);
    change(s, table);
    s.method_settings["rigid_dem"] = table;
    return s;
}

/// Radius 1, side by side in the middle of a wide box.
inline Packing two_discs(double gap) {
    Packing p;
    p.box.position = {-100.0, 100.0, -100.0, 100.0};
    p.center = {{-1.0 - 0.5 * gap, 0.0}, {1.0 + 0.5 * gap, 0.0}};
    p.radius = {1.0, 1.0};
    return p;
}

}  // namespace softgrain::rigid_dem
