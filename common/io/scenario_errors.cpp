#include "common/io/scenario_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <tuple>

#include "common/errors.hpp"

namespace softgrain::scenario_io {
namespace {
constexpr std::size_t most_shown = 50;
}  // namespace

void ErrorList::add(const Place& place, std::string_view subject, std::string_view text) {
    const bool named_by_option = !place.option.empty() && place.option == subject;
    entries_.push_back({place, named_by_option || subject.empty() ? std::string(text)
                                                                  : fmt::format("{} {}", subject, text)});
}

void ErrorList::throw_if_any() const {
    if (entries_.empty()) return;
    std::vector<Entry> sorted = entries_;
    const auto position = [](const Entry& e) {
        return std::make_tuple(!e.place.option.empty(), e.place.line, e.place.column);
    };
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](const Entry& a, const Entry& b) { return position(a) < position(b); });
    std::string all;
    for (const Entry& e : std::span(sorted).first(std::min(sorted.size(), most_shown))) {
        if (!all.empty()) all += '\n';
        all += e.place.option.empty()
                   ? fmt::format("{}:{}:{}: {}", name_, e.place.line, e.place.column, e.text)
                   : fmt::format("--set {}: {}", e.place.option, e.text);
    }
    if (sorted.size() > most_shown) all += fmt::format("\nand {} more errors", sorted.size() - most_shown);
    throw InputError(all);
}

}  // namespace softgrain::scenario_io
