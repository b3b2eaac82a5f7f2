#include "common/io/history_csv.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/observables/observable.hpp"

namespace softgrain {
namespace {

std::string line_of(std::span<const double> row) {
    // The shortest text that reads back to the same bits.
    return fmt::format("{}\n", fmt::join(row, ","));
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> parts;
    std::stringstream stream(line);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
}

}  // namespace

HistoryWriter::HistoryWriter(std::filesystem::path path, const std::vector<std::vector<double>>& rows)
    : path_(std::move(path)) {
    std::vector<std::string_view> names;
    for (const Observable& o : observables()) names.push_back(o.name);
    std::string text = fmt::format("{}\n", fmt::join(names, ","));
    for (const auto& row : rows) text += line_of(row);
    write_file_atomically(path_, text);
    file_.open(path_, std::ios::binary | std::ios::app);
    if (!file_) throw OutputError(fmt::format("{}: cannot append to it", path_.string()));
}

void HistoryWriter::observe(const GrainView&, const Sample& sample) {
    file_ << line_of(sample.row) << std::flush;
    if (file_) return;
    const int error = errno;
    const std::string_view cure = cure_of(error);
    throw OutputError(fmt::format("{}: cannot append a row: {}{}{}", path_.string(), std::strerror(error),
                                  cure.empty() ? "" : "; ", cure));
}

const std::vector<double>& History::column(std::string_view name) const {
    const auto it = columns.find(name);
    if (it == columns.end()) throw InputError(fmt::format("the history has no column '{}'", name));
    return it->second;
}

History read_history(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw InputError(fmt::format("{}: cannot read it", path.string()));
    std::string line;
    int number = 1;
    for (; std::getline(file, line) && line.starts_with('#');) ++number;
    const std::vector<std::string> names = split(line);
    History history;
    for (const std::string& name : names)
        if (name.empty() || !history.columns.try_emplace(name).second)
            throw InputError(fmt::format(
                "{}:{}: {}", path.string(), number,
                name.empty() ? "a column has no name" : fmt::format("two columns are named '{}'", name)));
    if (names.empty())
        throw InputError(fmt::format("{}:{}: expected a line of column names", path.string(), number));
    while (std::getline(file, line)) {
        ++number;
        const std::vector<std::string> parts = split(line);
        if (parts.size() != names.size())
            throw InputError(fmt::format("{}:{}: {} values, expected {}", path.string(), number, parts.size(),
                                         names.size()));
        for (std::size_t c = 0; c < names.size(); ++c) {
            double value = std::nan("");
            const char* end = parts[c].data() + parts[c].size();
            const auto [stop, error] = std::from_chars(parts[c].data(), end, value);
            if (error != std::errc{} || stop != end)
                throw InputError(fmt::format("{}:{}: '{}' is not a number", path.string(), number, parts[c]));
            history.columns[names[c]].push_back(value);
        }
    }
    return history;
}

}  // namespace softgrain
