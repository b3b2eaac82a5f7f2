// softgrain-render: pictures of runs and line plots, without a display.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "common/errors.hpp"
#include "viz/render/frames_command.hpp"
#include "viz/render/pictures_command.hpp"
#include "viz/render/plot_command.hpp"
#include "viz/render/vtk_errors.hpp"

namespace {

int report(const char* text, int code) {
    fmt::print(stderr, "softgrain-render: {}\n", text);
    return code;
}

/// The arguments, last one first as CLI11 wants them, with the numbers of these options apart: before it
/// knows of commas it counts words, and would take a RUN behind them for a number.
std::vector<std::string> arguments(int argc, char** argv) {
    std::vector<std::string> words;
    std::string before;
    for (int k = 1; k < argc; ++k) {
        std::string word = argv[k];
        const std::string option = word.substr(0, word.find('='));
        const auto takes_numbers = [](const std::string& name) {
            return name == "--range" || name == "--window";
        };
        if (takes_numbers(before) || (takes_numbers(option) && option != word)) {
            std::size_t comma = 0;
            for (; (comma = word.find(',')) != std::string::npos; word.erase(0, comma + 1))
                words.push_back(word.substr(0, comma));
        }
        words.push_back(word);
        before = argv[k];
    }
    std::reverse(words.begin(), words.end());
    return words;
}

void style_options(CLI::App& command, softgrain::DrawingStyle& style) {
    command.add_option("--field", style.field, "What colours the grains: cell data of grains.pvd")
        ->capture_default_str();
    command.add_option("--range", style.range, "MIN,MAX of the colours; else 2nd to 98th percentile with 0")
        ->delimiter(',')
        ->expected(2)
        ->allow_extra_args(false);
    command.add_flag("--parts", style.parts,
                     "Draw the parts of grains and the forces between them, of runs that wrote them; "
                     "--field may then be point data of parts.pvd");
    command
        .add_option("--window", style.window,
                    "LEFT,RIGHT,BOTTOM,TOP: draw this part only, as shares of width and height, 0 to 1")
        ->delimiter(',')
        ->expected(4)
        ->allow_extra_args(false);
    command.add_option("--width", style.width, "Width of each picture [pixels]; 0: by what is on it")
        ->capture_default_str();
}

CLI::Option* stage_option(CLI::App& command, std::vector<double>& at_packing_fraction) {
    return command.add_option("--at-phi", at_packing_fraction, "Stages by packing fraction in history.csv")
        ->delimiter(',')
        ->allow_extra_args(false);
}

void pictures_options(CLI::App& app, softgrain::PicturesRequest& request) {
    app.add_option("RUN", request.runs,
                   "Folders of runs, or of a comparison (all its runs), drawn side by side on one scale; "
                   "LABEL=RUN gives one another name");
    auto* at = app.add_option("--at", request.at,
                              "first, last (that all runs have reached), all (numbered pictures), or "
                              "fractions of the loading, 1 being the end of the longest run; default last")
                   ->delimiter(',')
                   ->allow_extra_args(false);
    stage_option(app, request.at_packing_fraction)->excludes(at);
    style_options(app, request.style);
    app.add_flag("--film", request.film, "All stages as numbered pictures and, by ffmpeg, as an MP4");
    app.add_option("--fps", request.fps,
                   "Pictures per second of the film; default 25, fewer if it would take less than 5 s");
    app.add_option("--out", request.out,
                   "Folder, or a file .png or .mp4; default: pictures in the folder of the first RUN");
}

void frames_options(CLI::App& command, softgrain::FramesRequest& request) {
    command.add_option("--run", request.runs, "LABEL=RUN_DIR; once for each run")->required()->take_all();
    auto* at =
        command.add_option("--at", request.at, "Stages as fractions of the list of frames")->delimiter(',');
    stage_option(command, request.at_packing_fraction)->excludes(at);
    style_options(command, request.style);
    command.add_option("--out", request.out, "Folder for the pictures")->required();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Draws runs and plots off-screen. SOFTGRAIN_RENDER=egl or xvfb chooses the graphics.\n"
        "Exit codes: 0 done, 2 bad input, 4 input/output or graphics failed.",
        "softgrain render"};
    app.footer(
        "Examples:\n"
        "  softgrain render results/default\n"
        "  softgrain render results/default --at-phi 0.82,0.95 --field aspect_ratio\n"
        "  softgrain render elastic=results/sdem plastic=results/bpm --film");
    softgrain::PicturesRequest pictures_request;
    pictures_options(app, pictures_request);
    softgrain::FramesRequest frames_request;
    CLI::App* frames = app.add_subcommand("frames",
                                          "One picture per run and loading stage, and all of them "
                                          "on one sheet (OUT/LABEL_1.png ..., OUT/sheet.png)");
    frames_options(*frames, frames_request);
    std::filesystem::path spec_file, plot_file;
    CLI::App* plot = app.add_subcommand("plot", "A line plot as PNG or SVG");
    plot->add_option("SPEC", spec_file, "JSON file; see viz/README.md")->required();
    plot->add_option("--out", plot_file, "File to write, ending in .png or .svg")->required();

    try {
        app.parse(arguments(argc, argv));
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        return report(error.what(), 2);
    }
    softgrain::collect_vtk_errors();
    try {
        if (frames->parsed()) {
            if (frames_request.at.empty() && frames_request.at_packing_fraction.empty())
                frames_request.at = {0.0, 0.5, 1.0};
            softgrain::draw_frames(frames_request);
        } else if (plot->parsed()) {
            softgrain::draw_plot(spec_file, plot_file);
        } else if (pictures_request.runs.empty()) {
            return report("which run? softgrain render RUN...; see softgrain render --help", 2);
        } else {
            softgrain::draw_pictures(pictures_request);
        }
    } catch (const softgrain::InputError& error) {
        return report(error.what(), 2);
    } catch (const std::exception& error) {
        return report(error.what(), 4);
    }
    return 0;
}
