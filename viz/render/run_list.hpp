#pragma once
// The runs named on the command line.
#include <filesystem>
#include <string>
#include <vector>

namespace softgrain {

struct NamedRun {
    std::string label;
    std::filesystem::path folder;
};

/// LABEL=RUN_DIR, split so that RUN_DIR is there if any split does that: labels and folders may hold '='.
/// Throws InputError naming `option`.
NamedRun labelled_run(const std::string& text, const std::string& option);

/// RUN_DIR, named by its folder; LABEL=RUN_DIR; or the folder of a comparison, which stands for its runs in
/// the order of comparison.csv, others after them by name. Equal names get that of the parent folder before
/// them. Throws InputError.
std::vector<NamedRun> find_runs(const std::vector<std::string>& words);

}  // namespace softgrain
