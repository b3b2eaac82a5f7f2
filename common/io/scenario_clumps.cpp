#include "common/io/scenario_clumps.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

#include "common/packing/clump_shape.hpp"

namespace softgrain::scenario_io {
namespace {

constexpr std::string_view form = "must be a list \"x y r, x y r\", a disc between two commas";

/// The three numbers of a disc and nothing else.
std::optional<Disc> disc_in(std::string_view text) {
    double value[3];
    for (double& one : value) {
        while (text.starts_with(' ')) text.remove_prefix(1);
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), one);
        if (error != std::errc{}) return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (!text.empty() && !text.starts_with(' ')) return std::nullopt;
    }
    if (text.find_first_not_of(' ') != text.npos) return std::nullopt;
    return Disc{{value[0], value[1]}, value[2]};
}

std::optional<std::vector<Disc>> discs_in(std::string_view text) {
    std::vector<Disc> discs;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find(',', start), text.size());
        const auto disc = disc_in(text.substr(start, end - start));
        if (!disc) return std::nullopt;
        discs.push_back(*disc);
        start = end + 1;
    }
    return discs;
}

std::vector<Disc> line_of(const CheckedTable& table, ErrorList& errors) {
    const auto count = static_cast<std::size_t>(table.settings.integer("clump_discs"));
    const auto n = static_cast<double>(count);
    const double elongation =
        table.has("clump_elongation") ? table.settings.number("clump_elongation") : 0.5 * (n + 1.0);
    if (!(elongation > 1.0 && elongation < n)) {
        errors.add(table.place_of("clump_elongation"), table.full("clump_elongation"),
                   fmt::format("must be > 1 and < {} so that {} discs in a line overlap, got {}", count,
                               count, elongation));
        return {};
    }
    return discs_in_line(count, elongation);
}

}  // namespace

std::vector<Disc> clump_of(const CheckedTable& table, ErrorList& errors) {
    const bool listed = table.has("clump"), in_line = table.has("clump_discs");
    const auto fail = [&](std::string_view key, std::string_view why) {
        errors.add(table.place_of(key), table.full(key), why);
        return std::vector<Disc>{};
    };
    if (!table.sound({"clump", "clump_discs", "clump_elongation", "aspect_ratio"})) return {};
    if (table.has("clump_elongation") && !in_line)
        return fail("clump_elongation", "has no effect without clump_discs: give that too, or remove it");
    if (!listed && !in_line) return {};
    if (listed && in_line) return fail("clump_discs", "and clump say the same: keep one");
    if (table.settings.number("aspect_ratio") != 1.0)
        return fail("aspect_ratio", "is for ellipses, and this class is one of clumps: remove one");
    if (in_line) return line_of(table, errors);

    const auto discs = discs_in(table.settings.text("clump"));
    if (!discs) return fail("clump", form);
    if (const std::string fault = clump_fault(*discs); !fault.empty()) return fail("clump", fault);
    return *discs;
}

std::string clump_text(std::span<const Disc> discs) {
    std::string text;
    for (const Disc& disc : discs)
        text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", disc.center.x(), disc.center.y(),
                            disc.radius);
    return text;
}

}  // namespace softgrain::scenario_io
