#pragma once
// Small runs of every method that take long enough to be disturbed, and the comparison of what they leave.
#include <set>

#include "common/io/run_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain::testing {

/// The bits of a checkpoint file that do not depend on clocks.
inline ::testing::AssertionResult same_checkpoint(const fs::path& one, const fs::path& other) {
    const RunFile a = read_run_file(one), b = read_run_file(other);
    if (a.state.state_hashes != b.state.state_hashes)
        return ::testing::AssertionFailure() << "state hashes differ";
    Checkpoint loop_a, loop_b;
    a.state.save(loop_a);
    b.state.save(loop_b);
    for (Checkpoint* loop : {&loop_a, &loop_b})
        loop->numbers.erase("history");  // nan in it; history.csv is compared
    if (const auto loops = same_bits(loop_a, loop_b); !loops) return loops;
    return same_bits(a.solver, b.solver);
}

/// Every file of two runs of the same scenario: names and bytes, but for run.json, which has clocks in it,
/// and the checkpoints, of which only what is computed is compared.
inline ::testing::AssertionResult same_results(const fs::path& one, const fs::path& other) {
    const auto files_of = [](const fs::path& folder) {
        std::set<fs::path> files;
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file() && entry.path().filename() != "run_previous.h5")
                files.insert(entry.path().lexically_relative(folder));
        return files;
    };
    const std::set<fs::path> files = files_of(one);
    if (const auto others = files_of(other); files != others) {
        auto failure = ::testing::AssertionFailure() << "not the same files:";
        for (const fs::path& file : files)
            if (!others.contains(file)) failure << " -" << file.string();
        for (const fs::path& file : others)
            if (!files.contains(file)) failure << " +" << file.string();
        return failure;
    }
    for (const fs::path& file : files)
        if (file != "run.json" && file != "run.h5" && content(one / file) != content(other / file))
            return ::testing::AssertionFailure() << file << " differs";
    return same_checkpoint(one / "run.h5", other / "run.h5");
}

class ReliabilityTest : public ProgramTest {
  protected:
    static std::ptrdiff_t lines(const std::string& text) {
        return std::count(text.begin(), text.end(), '\n');
    }
    /// `softgrain run` of six grains with all outputs and a checkpoint every 50 ms, a part of a second.
    std::vector<std::string> run_of(const std::string& method, const fs::path& out,
                                    const std::vector<std::string>& more = {}) const {
        const std::string rate = method == "bpm"    ? "1.2e-3"
                                 : method == "sdem" ? "3e-6"
                                 : method == "mpm"  ? "3e-4"
                                                    : "6e-7";
        const fs::path scenario = write(
            method + ".toml",
            "title = \"small\"\n[packing]\nsize_law = \"single\"\ncount = 6\n[[loading]]\nuntil_strain = "
            "0.02\n"
            "strain_rate = " +
                rate +
                "\n[sampling]\nstrain_interval = 0.002\nframe_every = 2\nparts = true\n"
                "measures = \"forces, tessellation\"\n"
                "[watch]\nenergy_residual = 0.5\nlost_contacts = 0\n"
                "[bpm]\ndiscs_per_grain = 30\n[mpm]\npoints_across_radius = 4\ndriver = \"explicit\"\n");
        std::vector<std::string> command{"run",   scenario.string(), "--method", method,
                                         "--out", out.string(),      "--quiet",  "--checkpoint-period",
                                         "0.05",  "--threads",       "1"};
        command.insert(command.end(), more.begin(), more.end());
        return command;
    }
};

}  // namespace softgrain::testing
