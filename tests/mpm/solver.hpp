#pragma once
// Solvers of small scenes for the tests of the material point method.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "mpm/method.hpp"
#include "mpm/solver.hpp"

namespace softgrain::mpm::test {

/// Settings of the table [mpm] at their defaults, to be changed.
inline Settings& settings(Scenario& scenario) {
    return scenario.method_settings.at("mpm");
}

/// Quasi-static.
inline Scenario scenario_with(double nu, int points_across_radius) {
    Scenario scenario;
    scenario.material.poisson_ratio = nu;
    scenario.method_settings.emplace("mpm", Settings(method().keys()));
    settings(scenario).set("points_across_radius", std::int64_t{points_across_radius});
    settings(scenario).set("driver", std::string("quasi_static"));
    return scenario;
}

/// A disc of radius 0.5, between four walls that touch it or, if not `all`, between those across y.
inline Packing one_grain(bool all) {
    Packing packing;
    packing.box.position = {all ? 0.0 : -2.0, all ? 1.0 : 3.0, 0.0, 1.0};
    packing.center = {{0.5, 0.5}};
    packing.radius = {0.5};
    return packing;
}

/// The box closes in about its middle, in y and if `all` in x, until it is this high.
inline void close_in(Solver& solver, double height, bool all) {
    const Box before = solver.view(Need::base).box;
    const double speed = 0.5 * (before.height() - height), across = all ? speed : 0.0;
    solver.advance({before, {across, -across, speed, -speed}}, 1.0);
}

/// Rows of numbers of a file with comments, those that begin with `count` numbers.
inline std::vector<std::vector<double>> read_rows(const std::string& path, std::size_t count) {
    std::ifstream file(path);
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(file, line);) {
        std::vector<double> row;
        const char* at = line.c_str();
        for (char* end = nullptr; row.size() < count; at = end + (*end == ',' ? 1 : 0)) {
            const double value = std::strtod(at, &end);
            if (end == at) break;
            row.push_back(value);
        }
        if (row.size() == count) rows.push_back(row);
    }
    return rows;
}

}  // namespace softgrain::mpm::test
