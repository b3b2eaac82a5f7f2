#include "common/io/scenario_driven.hpp"

#include <fmt/format.h>

#include <array>
#include <span>

#include "common/io/scenario_schema.hpp"
#include "common/io/scenario_stages.hpp"

namespace softgrain::scenario_io {
namespace {

using Words = std::initializer_list<std::string_view>;

constexpr std::array<std::string_view, 5> region_keys{"region_x", "region_y", "region_radius", "region_width",
                                                      "region_height"};

void must(const CheckedTable& table, Words keys, std::string_view at, std::string_view value,
          ErrorList& errors) {
    for (const std::string_view key : keys)
        if (!table.has(key))
            errors.add(table.place_of(at), table.full(at), fmt::format("= \"{}\" needs {}", value, key));
}

void must_not(const CheckedTable& table, Words keys, std::string_view what, ErrorList& errors) {
    for (const std::string_view key : keys)
        if (table.has(key))
            errors.add(table.place_of(key), table.full(key), fmt::format("is not for {}: remove it", what));
}

double number_or(const Settings& s, std::string_view key, double otherwise) {
    return optional_number(s, key).value_or(otherwise);
}

}  // namespace

void check_region(const CheckedTable& packing, const CheckedTable& box, ErrorList& errors) {
    if (!packing.has("region")) {
        for (const std::string_view key : region_keys)
            if (packing.has(key))
                errors.add(packing.place_of(key), packing.full(key), "needs packing.region");
        return;
    }
    if (!packing.sound({"region", "generator", "region_x", "region_y", "region_radius", "region_width",
                        "region_height"}))
        return;
    const auto fault = [&](std::string_view text) {
        errors.add(packing.place_of("region"), packing.full("region"), std::string(text));
    };
    if (generator_of(packing.settings) != Generator::random_sequential)
        return fault("is filled at random places: set packing.generator = \"random_sequential\"");
    if (packing.has("packing_fraction"))
        return fault("is filled by packing.count grains: remove packing.packing_fraction");
    if (!box.has("width") || !box.has("height"))
        return fault("needs the size of its box: give box.width and box.height");
    if (box.sound({"periodic"}) && box.settings.boolean("periodic"))
        return fault("needs a box with walls: set box.periodic = false");
    const bool disc = packing.settings.text("region") == region_names[0];
    if (disc) {
        must(packing, {"region_radius"}, "region", "disc", errors);
        must_not(packing, {"region_width", "region_height"}, "region = \"disc\"", errors);
    } else {
        must(packing, {"region_width", "region_height"}, "region", "rectangle", errors);
        must_not(packing, {"region_radius"}, "region = \"rectangle\"", errors);
    }
    if (!box.sound({"width", "height"}) || packing.has("region_radius") != disc ||
        (!disc && (!packing.has("region_width") || !packing.has("region_height"))))
        return;
    const PackingRegion region = *region_of(packing.settings, box.settings);
    const Vec2 half = disc ? Vec2::Constant(region.radius) : Vec2(0.5 * region.size);
    const Vec2 corner{box.settings.number("width"), box.settings.number("height")};
    if (((region.center - half).array() < 0.0).any() ||
        ((region.center + half).array() > corner.array()).any())
        fault("must lie inside the box");
}

std::optional<PackingRegion> region_of(const Settings& packing, const Settings& box) {
    if (!packing.has("region") || !box.has("width") || !box.has("height")) return std::nullopt;
    PackingRegion region;
    region.center = {number_or(packing, "region_x", 0.5 * box.number("width")),
                     number_or(packing, "region_y", 0.5 * box.number("height"))};
    region.radius = number_or(packing, "region_radius", 0.0);
    region.size = {number_or(packing, "region_width", 0.0), number_or(packing, "region_height", 0.0)};
    return region;
}

void set_region(Settings& packing, const std::optional<PackingRegion>& region) {
    if (!region) return;
    const bool disc = region->radius > 0.0;
    packing.set("region", std::string(region_names[disc ? 0 : 1]));
    packing.set("region_x", region->center.x());
    packing.set("region_y", region->center.y());
    if (disc) {
        packing.set("region_radius", region->radius);
        return;
    }
    packing.set("region_width", region->size.x());
    packing.set("region_height", region->size.y());
}

void check_driven(const CheckedTable& driven, ErrorList& errors) {
    if (!driven.sound({"kind"})) return;
    if (driven.settings.text("kind") == driven_kind_names[0]) {
        must(driven, {"center_x", "center_y", "radius"}, "kind", "ring", errors);
        must_not(driven, {"from_x", "from_y", "to_x", "to_y", "velocity_x", "velocity_y"}, "kind = \"ring\"",
                 errors);
    } else {
        must(driven, {"from_x", "from_y", "to_x", "to_y"}, "kind", "row", errors);
        must_not(driven, {"center_x", "center_y", "radius", "spin"}, "kind = \"row\"", errors);
    }
}

DrivenGrains driven_of(const Settings& s) {
    const auto point = [&](std::string_view x, std::string_view y) {
        return Vec2{number_or(s, x, 0.0), number_or(s, y, 0.0)};
    };
    DrivenGrains driven;
    driven.ring = s.text("kind") == driven_kind_names[0];
    driven.disc_radius = s.number("disc_radius");
    driven.spacing = s.number("spacing");
    driven.center = point("center_x", "center_y");
    driven.radius = number_or(s, "radius", 0.0);
    driven.spin = number_or(s, "spin", 0.0);
    driven.from = point("from_x", "from_y");
    driven.to = point("to_x", "to_y");
    driven.velocity = point("velocity_x", "velocity_y");
    return driven;
}

Settings settings_of(const DrivenGrains& driven) {
    Settings s;
    s.set("kind", std::string(driven_kind_names[driven.ring ? 0 : 1]));
    s.set("disc_radius", driven.disc_radius);
    s.set("spacing", driven.spacing);
    if (driven.ring) {
        s.set("center_x", driven.center.x());
        s.set("center_y", driven.center.y());
        s.set("radius", driven.radius);
        s.set("spin", driven.spin);
        return s;
    }
    s.set("from_x", driven.from.x());
    s.set("from_y", driven.from.y());
    s.set("to_x", driven.to.x());
    s.set("to_y", driven.to.y());
    s.set("velocity_x", driven.velocity.x());
    s.set("velocity_y", driven.velocity.y());
    return s;
}

}  // namespace softgrain::scenario_io
