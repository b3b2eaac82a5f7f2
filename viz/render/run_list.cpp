#include "viz/render/run_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "common/errors.hpp"

namespace softgrain {
namespace fs = std::filesystem;
namespace {

constexpr const char* frames_file = "grains.pvd";

bool is_run(const fs::path& folder) {
    return fs::exists(folder / frames_file);
}

/// Without '.', '..' and '/' at the end, so that it has a name.
fs::path full_path(const fs::path& folder) {
    const fs::path full = fs::absolute(folder).lexically_normal();
    return full.has_filename() ? full : full.parent_path();
}

std::string folder_name(const fs::path& folder) {
    return full_path(folder).filename().string();
}

std::optional<NamedRun> split_label(const std::string& text) {
    std::optional<NamedRun> first;
    for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1)) {
        if (at == 0 || at + 1 == text.size()) continue;
        NamedRun split{text.substr(0, at), text.substr(at + 1)};
        if (fs::is_directory(split.folder)) return split;
        if (!first) first = std::move(split);
    }
    return first;
}

/// First cells of the rows of comparison.csv, each once.
std::vector<std::string> order_of_comparison(const fs::path& folder) {
    std::vector<std::string> order;
    std::ifstream file(folder / "comparison.csv");
    for (std::string line; std::getline(file, line);) {
        const std::string name = line.substr(0, line.find(','));
        if (std::ranges::find(order, name) == order.end()) order.push_back(name);
    }
    return order;
}

std::vector<NamedRun> runs_within(const fs::path& folder) {
    std::vector<NamedRun> runs;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_directory() && is_run(entry.path()))
            runs.push_back({entry.path().filename().string(), entry.path()});
    const auto order = order_of_comparison(folder);
    std::ranges::sort(runs, {}, [&](const NamedRun& run) {
        return std::pair(std::ranges::find(order, run.label) - order.begin(), run.label);
    });
    return runs;
}

void add_runs(const std::string& word, std::vector<NamedRun>& runs) {
    NamedRun run{"", word};
    const bool is_folder = fs::is_directory(run.folder);
    if (const auto labelled = is_folder ? std::nullopt : split_label(word)) run = *labelled;
    if (!fs::is_directory(run.folder))
        throw InputError(fmt::format("{}: no such folder", run.folder.string()));
    if (is_run(run.folder)) {
        runs.push_back(run);
        return;
    }
    const auto within = runs_within(run.folder);
    if (within.empty())
        throw InputError(fmt::format("{}: is neither the folder of a run (it has no {}) nor of a comparison",
                                     run.folder.string(), frames_file));
    for (const NamedRun& one : within)
        runs.push_back({run.label.empty() ? "" : run.label + " " + one.label, one.folder});
}

}  // namespace

NamedRun labelled_run(const std::string& text, const std::string& option) {
    const auto split = split_label(text);
    if (!split) throw InputError(fmt::format("{} '{}': must be LABEL=RUN_DIR", option, text));
    return *split;
}

std::vector<NamedRun> find_runs(const std::vector<std::string>& words) {
    std::vector<NamedRun> runs;
    for (const std::string& word : words) add_runs(word, runs);
    std::map<std::string, int> count;
    for (const NamedRun& run : runs) ++count[folder_name(run.folder)];
    for (NamedRun& run : runs) {
        if (!run.label.empty()) continue;
        run.label = folder_name(run.folder);
        if (count[run.label] > 1)
            run.label = folder_name(full_path(run.folder).parent_path()) + "/" + run.label;
    }
    std::set<std::string> labels;
    for (const NamedRun& run : runs)
        if (!labels.insert(run.label).second)
            throw InputError(fmt::format("two runs have the name '{}'; name them, as LABEL={}", run.label,
                                         run.folder.string()));
    return runs;
}

}  // namespace softgrain
