#include "app/memory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "common/errors.hpp"

namespace softgrain {
namespace {

double grain_count(const Scenario& scenario) {
    double count = scenario.packing.count;
    if (scenario.packing.path) {
        std::ifstream file(*scenario.packing.path, std::ios::binary);
        count = static_cast<double>(std::count(std::istreambuf_iterator<char>(file), {}, '\n'));
    }
    for (const DrivenGrains& driven : scenario.driven) {
        const double length =
            driven.ring ? 2.0 * std::numbers::pi * driven.radius : (driven.to - driven.from).norm();
        count += 1.0 + length / (2.0 * driven.disc_radius * driven.spacing);
    }
    return count;
}

double discs_of_a_clump(const Scenario& scenario) {
    std::size_t most = 1;
    for (const GrainClass& one : scenario.classes) most = std::max(most, one.clump.size());
    return static_cast<double>(most);
}

double discs_of_an_aggregate(const Scenario& scenario, const Settings& bpm) {
    constexpr double area_share = 0.9;  // discs of a grain / its area
    if (!bpm.has("disc_diameter"))
        return bpm.has("discs_per_grain") ? static_cast<double>(bpm.integer("discs_per_grain")) : 100.0;
    const PackingSpec& packing = scenario.packing;
    const BoxSpec& box = scenario.box;
    const double largest = 2.0 * std::max(packing.radius_mean, packing.radius_max);
    double across2 = largest * largest;
    if (!packing.path && !packing.region && box.width && box.height)  // radii are scaled to the box
        across2 = 4.0 / std::numbers::pi * *box.width * *box.height / packing.count;
    const double disc = bpm.number("disc_diameter");
    return std::max(1.0, area_share * across2 / (disc * disc));
}

/// What the method makes of one grain, in bytes.
double bytes_of_a_grain(const Scenario& scenario, const Method& method) {
    const Settings& own = scenario.method_settings.at(std::string(method.name));
    if (method.name == "bpm") return 1.2e3 * discs_of_an_aggregate(scenario, own);
    if (method.name == "rigid_dem") return 6.0e3 * discs_of_a_clump(scenario);
    if (method.name == "sdem") return 7.0e3;
    const double points =
        std::numbers::pi * std::pow(static_cast<double>(own.integer("points_across_radius")), 2.0);
    return points * (own.text("driver") == "explicit" ? 3.0e2 : 2.0e3);
}

std::uint64_t number_in(const char* path) {
    std::ifstream file(path);
    std::uint64_t value = 0;
    return file >> value ? value : 0;  // "max": no limit
}

}  // namespace

double estimated_memory(const Scenario& scenario, const Method& method) {
    constexpr double program = 4e7;
    return program + grain_count(scenario) * bytes_of_a_grain(scenario, method);
}

std::uint64_t available_memory() {
    std::uint64_t bytes = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                          static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
    for (const char* limit : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
        if (const std::uint64_t most = number_in(limit); most > 0) bytes = std::min(bytes, most);
    return bytes;
}

void check_memory(const Scenario& scenario, const Method& method, std::uint64_t limit) {
    const double needed = estimated_memory(scenario, method);
    const auto most = static_cast<double>(limit > 0 ? limit : available_memory());
    if (needed <= most) return;
    throw InputError(
        fmt::format("{}: {} needs ~{:.2g} GB for ~{:.3g} grains; the limit is {:.2g} GB, see --memory",
                    scenario.source.string(), method.name, needed / 1e9, grain_count(scenario), most / 1e9));
}

}  // namespace softgrain
