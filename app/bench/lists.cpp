#include "app/bench/lists.hpp"

#include <algorithm>

namespace softgrain::bench {

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
}

std::vector<std::string> parts(std::string_view text) {
    std::vector<std::string> all;
    while (!text.empty()) {
        const auto comma = std::min(text.find(','), text.size());
        if (std::string word = trimmed(text.substr(0, comma)); !word.empty()) all.push_back(std::move(word));
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return all;
}

}  // namespace softgrain::bench
