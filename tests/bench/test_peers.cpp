// `softgrain bench peers`: what peers print, and tables of made-up ones.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "app/bench/peers/peer_tables.hpp"
#include "common/errors.hpp"

namespace softgrain::bench {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

Peer peer(const std::string& name) {
    return {name, "sdem", "CPU time", "p.sh", {}, {}, "", {"friction", "threads"}, "ours", "theirs"};
}

TEST(PeerTimes, AreBelowTheLastHeaderThatHasTheColumns) {
    const auto times = read_peer_times(peer("X"),
                                       "# noise\ncheck,friction,value\ncheck,0,1\n"
                                       "speed,friction,threads,ours,more,theirs\n"
                                       "speed,0.5,1,0.25,7,1.5\nspeed,0.5,2,0.125,7,1\na warning\n");
    ASSERT_EQ(times.size(), 2U);
    EXPECT_EQ(times[0].title, "friction 0.5, threads 1");
    EXPECT_EQ(times[0].ours, 0.25);
    EXPECT_EQ(times[0].theirs, 1.5);
    EXPECT_EQ(times[1].title, "friction 0.5, threads 2");
}

TEST(PeerTimes, OfAPeerThatPrintsNoneAreAnError) {
    EXPECT_THROW(read_peer_times(peer("X"), "friction,threads,ours\n0,1,2\n"), InputError);
    EXPECT_THROW(read_peer_times(peer("X"), "friction,threads,ours,theirs\n"), InputError);
    EXPECT_THROW(read_peer_times(peer("X"), "friction,threads,ours,theirs\n0,1,2,-\n"), InputError);
    EXPECT_THROW(read_peer_times(peer("X"), "friction,threads,ours,theirs\n0,1,0,1\n"), InputError);
}

TEST(Peers, RatiosAreMediansOfTurnsNotOfTimes) {
    const Peer one = peer("X");
    const PeerRow row{&one, "c", "", {1.0, 2.0, 4.0}, {3.0, 20.0, 16.0}};
    EXPECT_EQ(row.our_time(), 2.0);
    EXPECT_EQ(row.their_time(), 16.0);
    EXPECT_EQ(row.ratio(), 4.0) << "of 3, 10 and 4";
    EXPECT_EQ(row.least_ratio(), 3.0);
    EXPECT_EQ(row.largest_ratio(), 10.0);
}

TEST(Peers, TablesAndPlotShowEachCaseAndWhoIsMissing) {
    const Peer x = peer("X"), y = peer("Y");
    const PeerResults results{
        {{&x, "a", "1.2", {1.0}, {3.0}}, {&x, "b", "1.2", {1.0}, {12.0}}, {&y, "a", "", {2.0}, {1.0}}},
        {"Z: left out, z is missing: apt install z"}};
    const std::string text = peers_markdown(results);
    EXPECT_TRUE(has(text, "| X    |                       3 |   12 |")) << text;
    EXPECT_TRUE(has(text, "| Y    |                     0.5 |  0.5 |")) << text;
    EXPECT_TRUE(has(text, "- Z: left out, z is missing: apt install z\n")) << text;
    const std::string csv = peers_csv(results);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3) << csv;
    EXPECT_TRUE(has(csv, "\"X\",\"1.2\",sdem,\"b\",\"CPU time\",1,12,12,12,12,1,")) << csv;
    const auto plot = peers_plot(results);
    ASSERT_TRUE(plot);
    ASSERT_EQ(plot->series.size(), 3U + 1U) << "ours is the line at 1";
    EXPECT_EQ(plot->series[1].y, (std::vector<double>{1.0, 12.0}));
    EXPECT_EQ(plot->series[1].label, "") << "one of the legend for each peer";
    EXPECT_LT(*plot->y.min, 0.5);
    EXPECT_GT(*plot->y.max, 12.0);
    EXPECT_FALSE(peers_plot({}));
}

class PeerPlans : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(::testing::TempDir()) / ("softgrain_peers_" + std::to_string(::getpid()));
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    void script(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << "#!/bin/sh\n" << text;
        fs::permissions(folder / name, fs::perms::owner_all);
    }
    PeerPlan read(const std::string& text) const {
        std::ofstream(folder / "p.toml") << text;
        return read_peer_plan(folder / "p.toml");
    }
    static std::string one(const std::string& name, const std::string& more = "") {
        return "[[peer]]\nname = \"" + name + "\"\nmethod = \"sdem\"\nwhat = \"time\"\nprogram = \"" + name +
               ".sh\"\ncase = \"c\"\nours = \"o\"\ntheirs = \"t\"\n" + more;
    }
    fs::path folder;
};

TEST_F(PeerPlans, RunInTurnsAndLeaveOutWhatIsMissingOrFails) {
    const std::string log = (folder / "log").string();
    script("a.sh", "echo a >> " + log + "\necho c,o,t\necho 1,2,6\n");
    script("b.sh", "echo b $1 >> " + log + "\necho c,o,t\necho 1,1,3\n");
    script("bad.sh", "echo it went wrong >&2\nexit 3\n");
    const PeerPlan plan = read(one("a") + one("b", "arguments = \"7\"\n") + one("bad") +
                               one("gone", "needs = \"no_such_program: apt install it\"\n"));
    const PeerResults results = run_peers(plan, 2);
    std::ifstream file(log);
    std::string order;
    for (std::string line; std::getline(file, line);) order += line + ";";
    EXPECT_EQ(order, "a;b 7;a;b 7;");
    ASSERT_EQ(results.rows.size(), 2U);
    EXPECT_EQ(results.rows[0].ours.size(), 2U);
    EXPECT_EQ(results.rows[0].ratio(), 3.0);
    EXPECT_EQ(results.left_out,
              (std::vector<std::string>{"gone: left out, no_such_program is missing: apt install it",
                                        "bad: left out, it went wrong"}));
}

TEST_F(PeerPlans, ErrorsNameLineAndCure) {
    for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
             {"", "peer is missing"},
             {one("a", "needs = \"lmp\"\n"), "p.toml:9:9: peer.0.needs must be PROGRAM: how to get it"},
             {one("a") + one("a"), "peer.1.name names another peer already"},
             {one("a", "porgram = \"x\"\n"), "did you mean 'program'?"}}) {
        std::string got;
        try {
            read(text);
        } catch (const InputError& error) {
            got = error.what();
        }
        EXPECT_TRUE(has(got, said)) << "expected: " << said << "\ngot: " << got;
    }
}

TEST_F(PeerPlans, ThoseOfTheProjectAreSound) {
    for (const char* name : {"plan.toml", "quick.toml"}) {
        const fs::path path = fs::path(SOFTGRAIN_SOURCE) / "bench/peers" / name;
        for (const Peer& one : read_peer_plan(path).peers) {
            if (!one.program.ends_with(".sh")) continue;
            EXPECT_TRUE(fs::exists(path.parent_path() / one.program)) << one.program;
        }
    }
}

}  // namespace
}  // namespace softgrain::bench
