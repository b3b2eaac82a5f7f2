#include "app/bench/peers/peer_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "app/bench/plan_reader.hpp"

namespace softgrain::bench {
namespace {

class Reader : PlanReader {
  public:
    using PlanReader::PlanReader;

    PeerPlan read() {
        static const std::vector<KeySpec> keys = [] {
            std::vector<KeySpec> all;
            for (const char* name : {"name", "method", "what", "program", "arguments", "needs", "package",
                                     "case", "ours", "theirs"})
                all.push_back(text_key(name));
            return all;
        }();
        PeerPlan plan;
        plan.source = path_;
        known_tables({"peer"});
        needed("peer");
        for (const CheckedTable& table :
             tables("peer", keys, {"name", "method", "what", "program", "case", "ours", "theirs"}))
            if (is_method(table)) plan.peers.push_back(peer_of(table, plan));
        errors_.throw_if_any();
        return plan;
    }

  private:
    Peer peer_of(const CheckedTable& table, const PeerPlan& plan) {
        const Settings& given = table.settings;
        Peer peer{given.text("name"),
                  given.text("method"),
                  given.text("what"),
                  given.text("program"),
                  {},
                  {},
                  text(table, "package"),
                  parts(given.text("case")),
                  given.text("ours"),
                  given.text("theirs")};
        if (std::ranges::find(plan.peers, peer.name, &Peer::name) != plan.peers.end())
            add_error(table, "name", "names another peer already");
        std::istringstream words(text(table, "arguments"));
        for (std::string word; words >> word;) peer.arguments.push_back(word);
        for (const std::string& one : parts(text(table, "needs"))) {
            const auto colon = one.find(':');
            if (colon == std::string::npos) {
                add_error(table, "needs", fmt::format("must be PROGRAM: how to get it, got \"{}\"", one));
                continue;
            }
            peer.needs.push_back({trimmed(one.substr(0, colon)), trimmed(one.substr(colon + 1))});
        }
        return peer;
    }
};

}  // namespace

PeerPlan read_peer_plan(const std::filesystem::path& path) {
    return Reader(path).read();
}

}  // namespace softgrain::bench
