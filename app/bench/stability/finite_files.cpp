#include "app/bench/stability/finite_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/io/history_csv.hpp"
#include "common/io/run_file.hpp"
#include "viz/writers/vtp_values.hpp"

namespace softgrain::bench {
namespace {

namespace fs = std::filesystem;

/// Row of the first value that is not finite, from 1; an infinite one only, if it may be nan.
std::optional<std::size_t> bad_row(const std::vector<double>& values, bool may_be_nan) {
    const auto bad = std::ranges::find_if(
        values, [&](double v) { return !std::isfinite(v) && !(may_be_nan && std::isnan(v)); });
    if (bad == values.end()) return std::nullopt;
    return static_cast<std::size_t>(bad - values.begin()) + 1;
}

bool may_be_nan(const std::string& column, const fs::path& file, const Method& method) {
    if (file.filename() == "history.csv")
        return column == "inertial_number" || method.not_given.find(column) != std::string_view::npos;
    return file.filename().string().starts_with("tessellation");
}

std::optional<std::string> not_finite_in_csv(const fs::path& file, const Method& method) {
    for (const auto& [column, values] : read_history(file).columns)
        if (const auto row = bad_row(values, may_be_nan(column, file, method)))
            return fmt::format("{}: {}, row {}", file.filename().string(), column, *row);
    return std::nullopt;
}

std::optional<std::string> not_finite_in_checkpoint(const fs::path& file) {
    for (const auto& [name, values] : read_run_file(file).solver.numbers)
        if (bad_row(values, false)) return fmt::format("{}: {}", file.filename().string(), name);
    return std::nullopt;
}

}  // namespace

std::optional<std::string> not_finite_in_run(const fs::path& folder, const Method& method) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    for (const fs::path& file : files) {
        std::optional<std::string> bad;
        if (file.extension() == ".csv") bad = not_finite_in_csv(file, method);
        if (file.extension() == ".h5") bad = not_finite_in_checkpoint(file);
        if (file.extension() == ".vtp")
            if (const auto array = not_finite_in_vtp(file))
                bad = fmt::format("{}: {}", file.filename().string(), *array);
        if (bad) return bad;
    }
    return std::nullopt;
}

}  // namespace softgrain::bench
