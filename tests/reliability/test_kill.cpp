// kill -9 at random moments of every phase of a run; --resume must then end with the bits of a run left
// alone. SOFTGRAIN_KILLS sets how many (default 8), SOFTGRAIN_KILL_SEED where they fall.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/inotify.h>

#include <csignal>
#include <cstdlib>
#include <map>
#include <random>

#include "tests/reliability/runs.hpp"

namespace softgrain {
namespace {

using namespace testing;
using Clock = std::chrono::steady_clock;

constexpr const char* methods[] = {"sdem", "bpm", "rigid_dem", "mpm"};
constexpr const char* phases[] = {"preparation", "loading", "writing"};

int number_from(const char* variable, int otherwise) {
    const char* text = std::getenv(variable);
    return text == nullptr ? otherwise : std::atoi(text);
}

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// What happens to the files of a folder, one event for each.
class FileEvents {
  public:
    explicit FileEvents(const fs::path& folder) : descriptor_(::inotify_init1(IN_CLOEXEC)) {
        ::inotify_add_watch(descriptor_, folder.c_str(), IN_CREATE | IN_MODIFY | IN_MOVED_FROM | IN_MOVED_TO);
    }
    FileEvents(const FileEvents&) = delete;
    FileEvents& operator=(const FileEvents&) = delete;
    ~FileEvents() { ::close(descriptor_); }

    /// Returns once `count` of them came, or after `longest` seconds.
    void wait_for(int count, double longest) const {
        const auto begin = Clock::now();
        while (count > 0 && seconds_since(begin) < longest) {
            pollfd waiting{descriptor_, POLLIN, 0};
            if (::poll(&waiting, 1, 10) != 1) continue;
            alignas(inotify_event) char events[sizeof(inotify_event) + 256];
            if (::read(descriptor_, events, sizeof(events)) <= 0) return;
            --count;
        }
    }

  private:
    int descriptor_;
};

class Killed : public ReliabilityTest {
  protected:
    struct Straight {
        fs::path folder;
        double first_row = 0.0, whole = 0.0;  ///< [s]
    };

    Straight straight_run(const std::string& method) const {
        Straight run{folder / (method + "_straight")};
        const auto begin = Clock::now();
        const pid_t child = start(run_of(method, run.folder));
        wait_for_rows(run.folder / "history.csv", 1);
        run.first_row = seconds_since(begin);
        const Outcome outcome = wait_for(child);
        run.whole = seconds_since(begin);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return run;
    }

    /// True if the program was killed, false if it came to its end before.
    bool run_and_kill(const std::string& method, const fs::path& out, const std::string& phase,
                      const Straight& as, std::mt19937& random) const {
        const auto between = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        fs::create_directories(out);
        const FileEvents events(out);
        const pid_t child = start(run_of(method, out, {"--resume"}));
        if (phase == "writing")
            events.wait_for(static_cast<int>(between(1.0, 150.0)), as.whole);
        else
            std::this_thread::sleep_for(std::chrono::duration<double>(
                phase == "loading" ? between(as.first_row, as.whole) : between(0.0, as.first_row)));
        ::kill(child, SIGKILL);
        return wait_for(child).exit_code == -SIGKILL;
    }

    static bool is_left_half_written(const fs::path& out) {
        for (const auto& entry : fs::recursive_directory_iterator(out))
            if (entry.path().extension() == ".part") return true;
        return false;
    }
};

TEST_F(Killed, AtRandomMomentsEndsWithTheSameBits) {
    const int wanted = number_from("SOFTGRAIN_KILLS", 8);
    std::mt19937 random(static_cast<unsigned>(number_from("SOFTGRAIN_KILL_SEED", 1)));
    std::map<std::string, Straight> straight;
    for (const char* method : methods) straight[method] = straight_run(method);
    std::map<std::string, int> kills;
    int done = 0, half_written = 0, renames = 0;
    for (int run = 0; done < wanted; ++run) {
        ASSERT_LT(run, 20 * wanted) << "runs end before they can be killed";
        const std::string method = methods[run % 4];
        const fs::path out = folder / "broken";
        const int in_a_row = 1 + static_cast<int>(random() % 3);
        std::string history;
        for (int k = 0; k < in_a_row && done < wanted; ++k) {
            const std::string phase = phases[random() % 3];
            history += phase + " ";
            if (!run_and_kill(method, out, phase, straight[method], random)) break;
            ++done;
            ++kills[method + " " + phase];
            half_written += is_left_half_written(out) ? 1 : 0;
        }
        const Outcome last = softgrain(run_of(method, out, {"--resume"}));
        ASSERT_EQ(last.exit_code, 0) << method << " killed in " << history << last.err;
        // Between the two renames of a checkpoint there is no run.h5.
        const bool between_renames = last.err.find("run.h5: missing; going on from") != std::string::npos;
        ASSERT_TRUE(between_renames || last.err.empty()) << method << " killed in " << history << last.err;
        renames += between_renames ? 1 : 0;
        ASSERT_TRUE(same_results(straight[method].folder, out)) << method << " killed in " << history;
        fs::remove_all(out);
    }
    for (const auto& [what, count] : kills) std::printf("%4d kills in %s\n", count, what.c_str());
    std::printf("%4d of %d left a file half written, %d fell between two renames\n", half_written, done,
                renames);
}

}  // namespace
}  // namespace softgrain
