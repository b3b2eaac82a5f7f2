#include "app/markdown_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace softgrain {

std::string markdown_table(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> width(rows.front().size(), 3);
    for (const auto& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
    std::string text;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        for (std::size_t c = 0; c < rows[r].size(); ++c)
            text += fmt::format(fmt::runtime(c == 0 ? "| {:<{}} " : "| {:>{}} "), rows[r][c], width[c]);
        text += "|\n";
        if (r > 0) continue;
        for (std::size_t c = 0; c < width.size(); ++c)
            text += fmt::format("|{}{}", std::string(width[c] + 1, '-'), c == 0 ? "-" : ":");
        text += "|\n";
    }
    return text;
}

}  // namespace softgrain
