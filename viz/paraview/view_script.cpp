#include "viz/paraview/view_script.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

#include "common/io/atomic_file.hpp"
#include "view_script_text.hpp"

namespace softgrain {
namespace {

/// What view.py says of runs: the folder that it lies in.
constexpr std::string_view own_run = "RUNS = [\".\"]";
static_assert(view_script_text.find(own_run) != std::string_view::npos);

}  // namespace

void write_view_script(const std::filesystem::path& folder, const std::vector<std::string>& runs) {
    std::string text(view_script_text);
    // A JSON list of texts is one in Python too.
    text.replace(text.find(own_run), own_run.size(), "RUNS = " + nlohmann::json(runs).dump());
    write_file_atomically(folder / "view.py", text);
}

}  // namespace softgrain
