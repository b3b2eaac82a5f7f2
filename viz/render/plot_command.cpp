#include "viz/render/plot_command.hpp"

#include <fmt/format.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <fstream>
#include <iterator>
#include <string>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "viz/plot_data.hpp"
#include "viz/plot_svg.hpp"
#include "viz/render/graphics.hpp"
#include "viz/render/page.hpp"
#include "viz/render/plot_chart.hpp"

namespace softgrain {
namespace fs = std::filesystem;
namespace {

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(path.string() + ": cannot be read");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

void draw_plot(const fs::path& spec_file, const fs::path& out) {
    const bool as_svg = out.extension() == ".svg";
    if (!as_svg && out.extension() != ".png")
        throw InputError(fmt::format("--out {}: must end in .png or .svg", out.string()));
    PlotSpec spec = plot_spec_from_json(read_text(spec_file), spec_file.string());
    load_plot_data(spec, spec_file.parent_path());
    if (out.has_parent_path()) make_directories(out.parent_path());
    if (as_svg) return write_file_atomically(out, plot_svg(spec));
    vtkNew<vtkContextActor> actor;
    actor->GetScene()->AddItem(make_chart(spec));
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(actor);
    actor->GetScene()->SetRenderer(renderer);
    make_titles(spec).add_to(*renderer);
    const auto graphics = open_graphics();
    const auto image = draw_scene(*graphics, *renderer, spec.width, spec.height);
    write_png(out, *image);
}

}  // namespace softgrain
