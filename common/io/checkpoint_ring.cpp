#include "common/io/checkpoint_ring.hpp"

#include <fmt/format.h>

namespace softgrain {
namespace {

namespace fs = std::filesystem;
constexpr const char* newest = "run.h5";
constexpr const char* older = "run_previous.h5";
constexpr const char* damaged = "run_damaged.h5";

}  // namespace

bool has_checkpoint(const fs::path& folder) {
    return fs::exists(folder / newest) || fs::exists(folder / older);
}

FoundCheckpoint read_checkpoint(const fs::path& folder) {
    std::string wrong = fmt::format("{}: missing", (folder / newest).string());
    if (fs::exists(folder / newest) || !fs::exists(folder / older)) {
        try {
            return {read_run_file(folder / newest), folder / newest, ""};
        } catch (const DamagedFileError& error) {
            wrong = error.what();
        }
    }
    try {
        if (fs::exists(folder / older)) return {read_run_file(folder / older), folder / older, wrong};
    } catch (const DamagedFileError& error) {
        throw InputError(fmt::format("{}; {}; no checkpoint is left to go on from, start anew with --force",
                                     wrong, error.what()));
    }
    throw InputError(
        fmt::format("{}; there is no older checkpoint to go on from, start anew with --force", wrong));
}

void write_checkpoint(const fs::path& folder, const RunFile& content) {
    write_run_file(folder / newest, content, folder / older);
}

void put_damaged_checkpoint_aside(const fs::path& folder) {
    if (fs::exists(folder / newest)) fs::rename(folder / newest, folder / damaged);
}

void remove_checkpoints(const fs::path& folder) {
    // The newest last: if this is cut short, what is left is the whole run and not a part of it.
    for (const char* name : {damaged, older, newest}) fs::remove(folder / name);
}

}  // namespace softgrain
