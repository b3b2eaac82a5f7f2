#pragma once
// Small scenes that every method can run, and what each method is allowed to miss.
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "app/methods.hpp"
#include "common/solver.hpp"

namespace softgrain::testing {

/// Bands of one method, with the reason beside each in scenes.cpp.
struct Bands {
    std::string method;
    double placing;   ///< largest shift of a centroid when grains are placed [mean radius]
    double at_rest;   ///< largest drift of a free grain [mean radius]
    double symmetry;  ///< difference in position [mean radius] and area between a scene and its image
    double symmetry_of_stress;     ///< relative
    double equilibrium;            ///< relative difference between wall and Love-Weber stress at rest
    double ledger;                 ///< energy residual / external work
    double closed_pores;           ///< covered area may exceed the sum of grain areas by this share
    double loading_time;           ///< to compress by `squeeze` quasi-statically [R sqrt(rho / stress scale)]
    double servo_pressure;         ///< that servo-control is tried at [stress scale]
    double servo_inertial_number;  ///< of the walls then
    double servo_waves;  ///< time for each step of pressure [width / sqrt(stress scale / rho)]; 0: none
    double first_kick;   ///< of a run, by gravity [steps]
    double fall;         ///< relative error of the way of a free fall
    double weight;       ///< relative error of the mean force and stress of a column at rest
    double trembling;    ///< the same of a single step; 1: says nothing
    double cell =
        0.0;  ///< periodic cell: relative difference of stress by another choice of its edges; 0: none
};

const std::vector<Bands>& all_bands();
void PrintTo(const Bands& bands, std::ostream* out);

/// Defaults of the scenario file with these lines added (may be empty).
Scenario scenario_of(const std::string& method, const std::string& extra = "");

/// Nine grains of two sizes on a jittered square lattice, just apart, in a square box.
Packing nine_grains();

/// Four grains well apart in a square box, so that nothing has to find its place at the start.
Packing four_grains();

/// `side` x `side` equal grains on a square lattice, touching: enough contacts to make the threads work.
Packing square_lattice(int side);

/// The packing turned by 90 degrees or mirrored about the box's middle: x' = middle + image (x - middle).
Packing image_of(const Packing& packing, const Mat2& image);

bool has_friction(const Bands& bands);

/// A stage that goes to this pressure, and the scenario of such stages, with friction if the method has it.
LoadingStage to_pressure(double pressure, double inertial_number);
Scenario served(const Bands& bands, std::vector<LoadingStage> stages);

std::unique_ptr<Solver> make(const Bands& bands, const Scenario& scenario, const Packing& packing);

/// All four walls close in by `strain` of the box during `time`; `after_step` sees the walls at the end of
/// each step.
Box squeeze(
    Solver& solver, Box box, double strain, double time,
    const std::function<void(const Box&, double dt)>& after_step = [](const Box&, double) {});

/// A periodic cell shrinks by `strain` in both directions and shears by `shear` (of its height) during
/// `time`.
Box deform(
    Solver& solver, Box box, double strain, double shear, double time,
    const std::function<void(const Box&, double dt)>& after_step = [](const Box&, double) {});

/// One wall moves in by `strain` of the box.
Box push(
    Solver& solver, Box box, Wall wall, double strain, double time,
    const std::function<void(const Box&, double dt)>& after_step = [](const Box&, double) {});

}  // namespace softgrain::testing
