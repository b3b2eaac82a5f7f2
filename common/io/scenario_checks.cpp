#include "common/io/scenario_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/io/measure_files.hpp"
#include "common/io/scenario_document.hpp"
#include "common/io/scenario_schema.hpp"
#include "common/packing/generators.hpp"

namespace softgrain::scenario_io {
namespace {

constexpr double largest_size_ratio = 1000.0;
constexpr double largest_aspect_ratio = 100.0;

/// `smaller` must not be above `larger`; reported where one of them was given.
bool in_order(const CheckedTable& table, std::string_view smaller, std::string_view larger,
              ErrorList& errors) {
    const double low = table.settings.number(smaller);
    const double high = table.settings.number(larger);
    if (!table.sound({smaller, larger}) || low <= high) return true;
    if (table.has(larger))
        errors.add(table.place_of(larger), table.full(larger),
                   fmt::format("must be at least {} = {}, got {}", smaller, low, high));
    else
        errors.add(table.place_of(smaller), table.full(smaller),
                   fmt::format("must be at most {} = {}, got {}", larger, high, low));
    return false;
}

void check_radii(const CheckedTable& packing, ErrorList& errors) {
    if (!packing.sound({"size_law"})) return;
    const std::string& law = packing.settings.text("size_law");
    if (law == "single") return;
    if (law == "gaussian") {
        const bool above = in_order(packing, "radius_min", "radius_mean", errors);
        const bool below = in_order(packing, "radius_mean", "radius_max", errors);
        if (!above || !below) return;
    } else if (!in_order(packing, "radius_min", "radius_max", errors)) {
        return;
    }
    if (packing.sound({"radius_min", "radius_max"}) &&
        packing.settings.number("radius_max") > largest_size_ratio * packing.settings.number("radius_min"))
        errors.add(packing.place_of("radius_max"), packing.full("radius_max"),
                   fmt::format("must be at most {} times radius_min", largest_size_ratio));
}

void check_generator(const CheckedTable& packing, const CheckedTable& box, ErrorList& errors) {
    if (!packing.sound({"generator"}) || !box.sound({"periodic"})) return;
    for (const KeyFault& fault : generator_faults(generator_of(packing.settings),
                                                  packing.has("packing_fraction") || packing.has("region"),
                                                  box.settings.boolean("periodic")))
        errors.add(packing.place_of(fault.key), packing.full(fault.key), fault.message);
}

void check_packing_file(const CheckedTable& packing, const CheckedTable& box,
                        const std::filesystem::path& folder, ErrorList& errors) {
    const Place& place = packing.place_of("path");
    for (const auto& [key, given] : packing.given)
        if (key != "path")
            errors.add(given.place, packing.full(key),
                       "has no effect on a packing read from packing.path: remove one");
    if (!box.has("width") || !box.has("height"))
        errors.add(place, packing.full("path"), "needs the size of its box: give box.width and box.height");
    if (!packing.sound({"path"})) return;
    std::error_code status;
    if (packing.settings.text("path").empty())
        errors.add(place, packing.full("path"), "must not be empty");
    else if (const auto file = packing_file(packing, folder); !std::filesystem::is_regular_file(file, status))
        errors.add(place, packing.full("path"),
                   fmt::format("names a file that is not there: '{}'", file.string()));
}

bool lies_within(const std::filesystem::path& file, const std::filesystem::path& folder) {
    const auto whole = folder.empty() ? std::filesystem::current_path() : std::filesystem::absolute(folder);
    const auto from_there = file.lexically_relative(whole.lexically_normal());
    return !from_there.empty() && *from_there.begin() != "..";
}

}  // namespace

void check_inside(const CheckedTable& packing, const std::filesystem::path& folder, ErrorList& errors) {
    if (!packing.has("path") || !packing.sound({"path"})) return;
    const Place& place = packing.place_of("path");
    if (!place.option.empty() || std::filesystem::path(packing.settings.text("path")).is_absolute()) return;
    const auto file = packing_file(packing, folder);
    if (lies_within(file, folder) || lies_within(file, std::filesystem::current_path())) return;
    errors.add(
        place, packing.full("path"),
        fmt::format("leads out of the scenario's folder and of the current one, to '{}': run it from a "
                    "folder above both, or allow it with --allow-outside",
                    file.string()));
}

void check_packing(const CheckedTable& packing, const CheckedTable& box, const std::filesystem::path& folder,
                   ErrorList& errors) {
    if (packing.has("path")) {
        check_packing_file(packing, box, folder, errors);
        return;
    }
    check_radii(packing, errors);
    check_generator(packing, box, errors);
    if (box.has("width") != box.has("height")) {
        const bool width = box.has("width");
        errors.add(box.place_of(width ? "width" : "height"), box.full(width ? "width" : "height"),
                   fmt::format("needs {} too", box.full(width ? "height" : "width")));
    } else if (box.has("width") && box.sound({"width", "height"})) {
        const double aspect = box.settings.number("height") / box.settings.number("width");
        if (aspect > largest_aspect_ratio || aspect < 1.0 / largest_aspect_ratio)
            errors.add(box.place_of("height"), box.full("height"),
                       fmt::format("must be within a factor of {} of box.width", largest_aspect_ratio));
    }
}

void check_gravity(const CheckedTable& box, ErrorList& errors) {
    if (!box.sound({"periodic"}) || !box.settings.boolean("periodic")) return;
    for (const std::string_view key : {"gravity_x", "gravity_y"})
        if (box.sound({key}) && box.settings.number(key) != 0.0)
            errors.add(box.place_of(key), box.full(key),
                       "needs walls that carry the weight: set box.periodic = false, or leave it out");
}

void check_sampling(const CheckedTable& sampling, ErrorList& errors) {
    if (!sampling.sound({"measures"})) return;
    const std::vector<std::string> names = measures_in(sampling.settings.text("measures"));
    for (auto name = names.begin(); name != names.end(); ++name) {
        const bool known =
            std::find(measure_names.begin(), measure_names.end(), *name) != measure_names.end();
        if (known && std::find(names.begin(), name, *name) == name) continue;
        errors.add(sampling.place_of("measures"), sampling.full("measures"),
                   known ? fmt::format("names '{}' twice", *name)
                         : fmt::format("names '{}', known are {}", *name, join(measure_names)));
        return;
    }
}

std::filesystem::path packing_file(const CheckedTable& packing, const std::filesystem::path& folder) {
    const std::filesystem::path path = packing.settings.text("path");
    if (path.empty()) return path;
    const bool from_option = !packing.place_of("path").option.empty();
    return std::filesystem::absolute(from_option ? path : folder / path).lexically_normal();
}

}  // namespace softgrain::scenario_io
