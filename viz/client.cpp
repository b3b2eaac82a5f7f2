#include "viz/client.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <system_error>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "viz/plot_data.hpp"
#include "viz/plot_svg.hpp"
#include "viz/run_program.hpp"

namespace softgrain {
namespace fs = std::filesystem;
namespace {

constexpr const char* renderer_name = "softgrain-render";

std::optional<std::string> run_renderer(std::vector<std::string> arguments) {
    const fs::path renderer = find_renderer();
    if (renderer.empty())
        return fmt::format("{} was not found beside the executable; set SOFTGRAIN_RENDER_EXE to its path",
                           renderer_name);
    arguments.insert(arguments.begin(), renderer.string());
    return run_program(arguments);
}

std::string join(const std::vector<double>& values) {
    return fmt::format("{}", fmt::join(values, ","));
}

}  // namespace

fs::path find_renderer() {
    std::error_code error;
    if (const char* given = std::getenv("SOFTGRAIN_RENDER_EXE"); given != nullptr && *given != '\0')
        return fs::exists(given, error) ? fs::path(given) : fs::path();
    const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
    if (error) return {};
    for (const fs::path& place : {here, here / "../libexec/softgrain", here / "../libexec"})
        if (fs::exists(place / renderer_name, error)) return place / renderer_name;
    return {};
}

std::optional<std::string> render_frames(const FramesSpec& spec) {
    std::vector<std::string> arguments{
        "frames", "--field", spec.field, "--out", spec.out.string(), "--width", std::to_string(spec.width)};
    for (const FramesSpec::Run& run : spec.runs) {
        arguments.emplace_back("--run");
        arguments.push_back(run.label + "=" + run.directory.string());
    }
    if (spec.at_packing_fraction.empty())
        arguments.insert(arguments.end(), {"--at", join(spec.at)});
    else
        arguments.insert(arguments.end(), {"--at-phi", join(spec.at_packing_fraction)});
    if (spec.range) arguments.push_back(fmt::format("--range={},{}", spec.range->first, spec.range->second));
    if (spec.parts) arguments.emplace_back("--parts");
    if (spec.window)
        arguments.insert(arguments.end(), {"--window", fmt::format("{}", fmt::join(*spec.window, ","))});
    return run_renderer(std::move(arguments));
}

std::optional<std::string> render_plot(const PlotSpec& spec, const fs::path& out) {
    try {
        const fs::path folder = fs::absolute(out).parent_path();
        PlotSpec beside = spec;
        for (PlotSeries& series : beside.series)
            if (!series.csv.empty()) series.csv = fs::proximate(fs::absolute(series.csv), folder);
        fs::path spec_file = out;
        spec_file.replace_extension(".json");
        make_directories(folder);
        write_file_atomically(spec_file, plot_spec_to_json(beside));
        if (out.extension() == ".svg") {
            load_plot_data(beside, folder);
            write_file_atomically(out, plot_svg(beside));
            return std::nullopt;
        }
        return run_renderer({"plot", spec_file.string(), "--out", out.string()});
    } catch (const std::exception& error) {
        return error.what();
    }
}

}  // namespace softgrain
