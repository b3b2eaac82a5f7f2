#include "viz/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <utility>

#include "common/errors.hpp"

namespace softgrain {
namespace {

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t comma = line.find(',');
        std::string_view cell = line.substr(0, comma);
        while (!cell.empty() && (cell.front() == ' ' || cell.front() == '"')) cell.remove_prefix(1);
        while (!cell.empty() && (cell.back() == ' ' || cell.back() == '"' || cell.back() == '\r'))
            cell.remove_suffix(1);
        cells.push_back(cell);
        if (comma == std::string_view::npos) return cells;
        line.remove_prefix(comma + 1);
    }
}

bool parse(std::string_view cell, double& value) {
    if (cell.empty()) {
        value = std::numeric_limits<double>::quiet_NaN();
        return true;
    }
    const auto end = cell.data() + cell.size();
    const auto parsed = std::from_chars(cell.data(), end, value);
    return parsed.ec == std::errc{} && parsed.ptr == end;
}

}  // namespace

CsvTable::CsvTable(std::filesystem::path path) : path_(std::move(path)) {
    std::ifstream file(path_);
    if (!file) throw InputError(path_.string() + ": cannot be read");
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        if (line.empty() || line == "\r" || line.front() == '#') continue;
        const auto cells = split(line);
        if (names_.empty()) {
            names_.assign(cells.begin(), cells.end());
            columns_.resize(names_.size());
            continue;
        }
        const bool half_written = file.eof() && cells.size() < names_.size();
        if (half_written) break;
        if (cells.size() != names_.size())
            throw InputError(fmt::format("{}:{}: {} cells where the header has {}", path_.string(), number,
                                         cells.size(), names_.size()));
        for (std::size_t c = 0; c < cells.size(); ++c) {
            double value = 0.0;
            if (!parse(cells[c], value))
                throw InputError(
                    fmt::format("{}:{}: '{}' is not a number", path_.string(), number, cells[c]));
            columns_[c].push_back(value);
        }
    }
    if (names_.empty()) throw InputError(path_.string() + ": has no header line");
}

bool CsvTable::has(std::string_view name) const {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
}

const std::vector<double>& CsvTable::column(std::string_view name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end())
        throw InputError(
            fmt::format("{}: no column '{}'; there are {}", path_.string(), name, fmt::join(names_, ", ")));
    return columns_[static_cast<std::size_t>(found - names_.begin())];
}

}  // namespace softgrain
