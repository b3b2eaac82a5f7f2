// softgrain-render: pictures of runs and line plots, without a display.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "common/errors.hpp"
#include "viz/render/frames_command.hpp"
#include "viz/render/plot_command.hpp"
#include "viz/render/vtk_errors.hpp"

namespace {

int report(const char* text, int code) {
    fmt::print(stderr, "softgrain-render: {}\n", text);
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Draws runs and plots off-screen. SOFTGRAIN_RENDER=egl or xvfb chooses the graphics.\n"
        "Exit codes: 0 done, 2 bad input, 4 input/output or graphics failed.",
        "softgrain-render"};
    app.require_subcommand(1);

    softgrain::FramesRequest request;
    CLI::App* frames = app.add_subcommand("frames",
                                          "One picture per run and loading stage, and all of them "
                                          "on one sheet (OUT/LABEL_1.png ..., OUT/sheet.png)");
    frames->add_option("--run", request.runs, "LABEL=RUN_DIR; once for each run")->required()->take_all();
    auto* at =
        frames->add_option("--at", request.at, "Stages as fractions of the list of frames")->delimiter(',');
    frames->add_option("--at-phi", request.at_packing_fraction, "Stages by packing fraction in history.csv")
        ->delimiter(',')
        ->excludes(at);
    frames->add_option("--field", request.field, "Cell data of grains.pvd that colours the grains")
        ->capture_default_str();
    frames->add_option("--range", request.range, "MIN,MAX of the colours; else 2nd to 98th percentile with 0")
        ->delimiter(',')
        ->expected(2);
    frames->add_flag("--parts", request.parts,
                     "Draw the parts of grains and the forces between them, of runs that wrote them; "
                     "--field may then be point data of parts.pvd");
    frames
        ->add_option("--window", request.window,
                     "LEFT,RIGHT,BOTTOM,TOP: draw this part only, as shares of width and height, 0 to 1")
        ->delimiter(',')
        ->expected(4);
    frames->add_option("--out", request.out, "Folder for the pictures")->required();
    frames->add_option("--width", request.width, "Width of each picture [pixels]")->capture_default_str();

    std::filesystem::path spec_file, plot_file;
    CLI::App* plot = app.add_subcommand("plot", "A line plot as PNG");
    plot->add_option("SPEC", spec_file, "JSON file; see viz/README.md")->required();
    plot->add_option("--out", plot_file, "File to write, ending in .png")->required();

    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        return report(error.what(), 2);
    }
    softgrain::collect_vtk_errors();
    try {
        if (frames->parsed()) {
            if (request.at.empty() && request.at_packing_fraction.empty()) request.at = {0.0, 0.5, 1.0};
            softgrain::draw_frames(request);
        } else {
            softgrain::draw_plot(spec_file, plot_file);
        }
    } catch (const softgrain::InputError& error) {
        return report(error.what(), 2);
    } catch (const std::exception& error) {
        return report(error.what(), 4);
    }
    return 0;
}
