// What the generators of packings cost and give, with the same radii for all: a CSV line for each generator
// and seed, then a table of their means. See docs/packings.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <ctime>
#include <fstream>

#include "common/observables/fabric.hpp"
#include "common/packing/generators.hpp"
#include "common/packing/jam.hpp"
#include "common/packing/overlap_energy.hpp"
#include "common/packing/size_laws.hpp"

namespace softgrain {
namespace {

// In mean radii.
constexpr double touching = 1e-4;                       // gap of a contact as it was made
constexpr double near = 0.2;                            // gap of near neighbours
constexpr double first_squeeze = 1e-4, squeeze = 1e-3;  // linear strains
constexpr double still_free = 1e-6;                     // overlap of discs that do not carry each other
constexpr double balance = 1e-3;                        // net force / mean overlap of discs that do
constexpr double weakest = 1e-2;                        // overlap / mean overlap of a contact that carries
constexpr int most_steps = 100'000;
constexpr double fewest = 0.1;  // pairs per grain that have a fabric

struct Options {
    int grains = 1000;
    int seeds = 3;
    std::string csv;
};

/// One row of the table: a generator with the packing fraction asked of it.
struct Row {
    Generator generator;
    std::optional<double> asked;
};

struct Result {
    double cpu_seconds = 0.0, packing_fraction = 0.0;
    double radius_error = 0.0;  ///< largest relative change of a radius
    double coordination = 0.0;  ///< 2 N_gg / N as it was made
    Mat2 contact_fabric = Mat2::Zero(), near_fabric = Mat2::Zero();
    double strain_to_carry = 0.0;  ///< linear, until the discs carry each other
    CarryingDiscs carrying;
    double carrying_fraction = 0.0;  ///< packing fraction there
};

struct Near {
    Mat2 fabric = Mat2::Zero();
    double per_grain = 0.0;
};
/// Of the pairs with a smaller gap; lengths in mean radii.
Near near_pairs(const std::vector<Vec2>& center, const std::vector<double>& radius, double gap) {
    NeighborList list;
    list.build(center, radius, gap);
    Near result;
    for (const Pair& pair : list.pairs()) {
        const Vec2 normal =
            (center[static_cast<std::size_t>(pair.j)] - center[static_cast<std::size_t>(pair.i)])
                .normalized();
        result.fabric += normal * normal.transpose();
    }
    const auto pairs = static_cast<double>(list.pairs().size());
    result.per_grain = 2.0 * pairs / static_cast<double>(center.size());
    result.fabric = result.per_grain < fewest ? Mat2(Mat2::Zero()) : Mat2(result.fabric / pairs);
    return result;
}

/// Squeezes the sample as a whole until its discs carry each other at rest.
void squeeze_until_carrying(OverlapEnergy& discs, Result& result) {
    const double width = discs.box().width();
    for (double strain = first_squeeze;; strain += squeeze) {
        discs.scale((1.0 - strain) * width / discs.box().width());
        const auto state = discs.relax(balance, still_free, most_steps);
        if (state.largest_overlap <= still_free) continue;
        result.strain_to_carry = strain;
        result.carrying = carrying_discs(discs.contacts(weakest * state.mean_overlap), discs.center().size());
        result.carrying_fraction = disc_area(discs.radius()) / discs.box().area();
        return;
    }
}

Result measure(const Row& row, const Options& options, int seed) {
    PackingSpec spec;
    spec.count = options.grains;
    Random random(static_cast<std::uint64_t>(seed));
    const std::vector<double> radii = draw_radii(spec, random);

    const std::clock_t began = std::clock();
    const Packing packing = generate(row.generator, radii, {.packing_fraction = row.asked}, random);
    Result result;
    result.cpu_seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
    result.packing_fraction = packing.packing_fraction_undeformed();
    for (std::size_t g = 0; g < radii.size(); ++g)
        result.radius_error = std::max(result.radius_error, std::abs(packing.radius[g] / radii[g] - 1.0));

    const double mean = packing.mean_radius();
    std::vector<Vec2> center = packing.center;
    std::vector<double> radius = packing.radius;
    for (Vec2& c : center) c /= mean;
    for (double& r : radius) r /= mean;
    const Near contacts = near_pairs(center, radius, touching);
    result.coordination = contacts.per_grain;
    result.contact_fabric = contacts.fabric;
    result.near_fabric = near_pairs(center, radius, near).fabric;
    OverlapEnergy discs(std::move(radius), std::move(center),
                        Box{{0.0, packing.box.width() / mean, 0.0, packing.box.height() / mean}});
    squeeze_until_carrying(discs, result);
    return result;
}

std::string name_of(const Row& row) {
    const std::string_view name = generator_names[static_cast<std::size_t>(row.generator)];
    return row.asked ? fmt::format("{} to {}", name, *row.asked) : std::string(name);
}

/// nan if there were too few pairs.
double anisotropy(const Mat2& fabric) {
    return fabric.isZero(0.0) ? std::nan("") : fabric_of(fabric).anisotropy;
}

std::string csv_line(const Row& row, int seed, const Options& options, const Result& r) {
    const int carrying = options.grains - r.carrying.rattlers;
    return fmt::format("{},{},{:.4f},{:.6f},{:.3g},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{:.4f},{:.6f}\n",
                       name_of(row), seed, r.cpu_seconds, r.packing_fraction, r.radius_error, r.coordination,
                       anisotropy(r.contact_fabric), anisotropy(r.near_fabric),
                       r.near_fabric(1, 1) - r.near_fabric(0, 0), r.strain_to_carry, r.carrying.rattlers,
                       r.carrying.contacts - (2 * carrying + 1), r.carrying.coordination_number,
                       r.carrying_fraction);
}

/// Means over the seeds; the fabrics are those of the mean tensors.
void print_row(const Row& row, const std::vector<Result>& results) {
    Result sum;
    double squares = 0.0, rattlers = 0.0, carried = 0.0;
    const auto n = static_cast<double>(results.size());
    for (const Result& r : results) {
        sum.cpu_seconds += r.cpu_seconds / n;
        sum.packing_fraction += r.packing_fraction / n;
        sum.radius_error = std::max(sum.radius_error, r.radius_error);
        sum.coordination += r.coordination / n;
        sum.contact_fabric += r.contact_fabric / n;
        sum.near_fabric += r.near_fabric / n;
        sum.strain_to_carry += r.strain_to_carry / n;
        rattlers += r.carrying.rattlers / n;
        carried += r.carrying.coordination_number / n;
    }
    for (const Result& r : results) squares += std::pow(r.packing_fraction - sum.packing_fraction, 2) / n;
    fmt::print(
        "| {} | {:.3g} | {:.4f} +- {:.4f} | {:.1g} | {:.3f} | {:.3f} | {:.2f} | {:.4f} | {:.2f} | {:.0f} |\n",
        name_of(row), sum.cpu_seconds, sum.packing_fraction, std::sqrt(squares), sum.radius_error,
        anisotropy(sum.contact_fabric), anisotropy(sum.near_fabric), sum.coordination, sum.strain_to_carry,
        carried, rattlers);
    std::fflush(stdout);
}

void run(const Options& options) {
    using enum Generator;
    std::ofstream csv;
    if (!options.csv.empty()) csv.open(options.csv);
    csv << "generator,seed,cpu_seconds,packing_fraction,radius_error,coordination_as_made,contact_anisotropy,"
           "near_anisotropy,near_yy_minus_xx,strain_to_carry,rattlers,contacts_beyond_isostatic,"
           "coordination_carrying,packing_fraction_carrying\n";
    fmt::print(
        "| generator | CPU time [s] | packing fraction | change of radii | anisotropy of contacts | of near "
        "neighbours | Z as made | strain to carry | Z then | rattlers then |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (const Row& row : {Row{random_sequential, 0.5}, Row{geometric, {}}, Row{deposition, {}},
                           Row{compaction, 0.7}, Row{compaction, {}}, Row{growth, 0.7}, Row{growth, {}}}) {
        std::vector<Result> results;
        for (int seed = 1; seed <= options.seeds; ++seed) {
            results.push_back(measure(row, options, seed));
            csv << csv_line(row, seed, options, results.back()) << std::flush;
        }
        print_row(row, results);
    }
}

}  // namespace
}  // namespace softgrain

int main(int argc, char** argv) {
    softgrain::Options options;
    CLI::App app("Packings by every generator");
    app.add_option("--grains", options.grains)->check(CLI::Range(10, 1'000'000));
    app.add_option("--seeds", options.seeds)->check(CLI::Range(1, 1000));
    app.add_option("--csv", options.csv, "a line for each generator and seed");
    CLI11_PARSE(app, argc, argv);
    softgrain::run(options);
    return 0;
}
