#include "app/bench/results_folder.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "viz/client.hpp"

namespace softgrain::bench {

void refuse_to_replace(const std::filesystem::path& file, bool force) {
    if (!force && std::filesystem::exists(file))
        throw InputError(
            fmt::format("{}: holds results already; replace them with --force, or choose another --out",
                        file.parent_path().string()));
}

void draw(const PlotSpec& plot, const std::filesystem::path& folder, const std::string& name) {
    if (const auto failed = render_plot(plot, folder / (name + ".svg")))
        throw OutputError(fmt::format("{}.svg: {}", name, *failed));
}

}  // namespace softgrain::bench
