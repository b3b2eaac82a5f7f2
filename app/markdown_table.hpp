#pragma once
// Tables in Markdown.
#include <string>
#include <vector>

namespace softgrain {

/// The first row is the header; the first column is set left, the others right. All rows have as many cells.
std::string markdown_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace softgrain
