#include "app/report/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>

#include "app/report/curve_error.hpp"
#include "app/report/html.hpp"
#include "app/report/words.hpp"
#include "viz/client.hpp"
#include "viz/markup.hpp"

namespace softgrain::report {
namespace {

namespace fs = std::filesystem;

constexpr double least_range = 0.02;  ///< of packing fraction; below it stages are shares of the loading

/// Tried one after the other until the pictures are small enough.
struct Effort {
    int stages, width;
};
constexpr std::array efforts{Effort{7, 720}, Effort{7, 480}, Effort{4, 480}, Effort{2, 400}};

std::string read_bytes(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<double> evenly(double low, double high, int count) {
    std::vector<double> values;
    for (int k = 0; k < count; ++k) values.push_back(low + (high - low) * k / (count - 1));
    return values;
}

std::string note_of(const MethodResult& result, double packing_fraction_asked) {
    const double reached = covered(*result.history).high;
    if (reached > packing_fraction_asked - same_packing) return "";
    return fmt::format("ended at packing fraction {}; its last frame", packing_fraction(reached));
}

Pictures draw(const std::vector<MethodResult>& results, const fs::path& folder, bool parts,
              const Effort& effort) {
    FramesSpec frames;
    for (const MethodResult& result : results)
        if (result.history) frames.runs.push_back({result.report.method, folder / result.report.method});
    frames.parts = parts;
    frames.width = effort.width;
    frames.out = folder / "report_pictures";
    const auto [low, high] = packing_fraction_range(results);
    const bool by_packing = high - low > least_range;
    if (by_packing)
        for (const double phi : evenly(low, high, effort.stages))
            frames.at_packing_fraction.push_back(std::round(1000.0 * phi) / 1000.0);
    else
        frames.at = evenly(0.0, 1.0, effort.stages);
    Pictures pictures;
    if (const auto error = render_frames(frames)) {
        pictures.failure = *error;
    } else {
        for (int s = 0; s < effort.stages; ++s) {
            const auto at = static_cast<std::size_t>(s);
            auto& stage = pictures.stages.emplace_back();
            stage.name = by_packing ? "packing fraction " + packing_fraction(frames.at_packing_fraction[at])
                                    : percent(frames.at[at]) + " of the loading";
            for (const MethodResult& result : results) {
                stage.png.push_back(
                    result.history
                        ? read_bytes(frames.out / fmt::format("{}_{}.png", result.report.method, s + 1))
                        : "");
                stage.note.push_back(
                    by_packing && result.history ? note_of(result, frames.at_packing_fraction[at]) : "");
            }
        }
    }
    std::error_code ignored;  // they are in the page now
    fs::remove_all(frames.out, ignored);
    return pictures;
}

std::size_t size_of(const Pictures& pictures) {
    std::size_t bytes = 0;
    for (const PictureStage& stage : pictures.stages)
        for (const std::string& png : stage.png) bytes += png.size();
    return bytes;
}

std::string stage_markup(const std::vector<MethodResult>& results, const PictureStage& stage, bool last) {
    std::string out = fmt::format("<div class=\"stage{}\" data-name=\"{}\">\n", last ? " shown last" : "",
                                  escape_markup(stage.name));
    for (std::size_t k = 0; k < results.size(); ++k) {
        if (stage.png[k].empty()) continue;
        const std::string method = escape_markup(results[k].report.method);
        out += fmt::format("<figure><img src=\"data:image/png;base64,{}\" alt=\"{} at {}\">",
                           base64(stage.png[k]), method, escape_markup(stage.name));
        if (!stage.note[k].empty())
            out += fmt::format("<figcaption>{} {}</figcaption>", method, escape_markup(stage.note[k]));
        out += "</figure>\n";
    }
    return out + "</div>\n";
}

}  // namespace

Pictures draw_pictures(const std::vector<MethodResult>& results, const fs::path& folder, bool parts,
                       std::size_t most_bytes) {
    if (std::ranges::none_of(results, [](const MethodResult& r) { return r.history.has_value(); }))
        return {{}, "no method made a step"};
    Pictures pictures;
    for (const Effort& effort : efforts) {
        pictures = draw(results, folder, parts, effort);
        if (!pictures.failure.empty() || size_of(pictures) <= most_bytes) return pictures;
    }
    return pictures;
}

std::string pictures_section(const std::vector<MethodResult>& results, const Pictures& pictures) {
    if (!pictures.failure.empty()) return element("p", "No pictures: " + pictures.failure);
    const std::size_t last = pictures.stages.size() - 1;
    const auto drawn =
        std::ranges::count_if(results, [](const MethodResult& r) { return r.history.has_value(); });
    std::string out = fmt::format(
        "<div id=\"loading\" hidden><label for=\"stage\">Stage of the loading</label>"
        "<input type=\"range\" id=\"stage\" min=\"0\" max=\"{0}\" step=\"1\" value=\"{0}\">"
        "<output for=\"stage\" id=\"stage-name\">{1}</output></div>\n<div id=\"stages\"{2}>\n",
        last, escape_markup(pictures.stages[last].name), drawn == 3 ? " class=\"of-three\"" : "");
    for (std::size_t s = 0; s <= last; ++s) out += stage_markup(results, pictures.stages[s], s == last);
    return out +
           "</div>\n<p class=\"note\">For each method the frame nearest to the stage; colours, "
           "force lines and "
           "metres per pixel are the same in all pictures and stages. <span class=\"screen\">The arrow keys "
           "move the slider.</span></p>\n";
}

}  // namespace softgrain::report
