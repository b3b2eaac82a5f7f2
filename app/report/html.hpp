#pragma once
// Pieces of a page. Every function that takes plain text escapes it; `markup` is HTML already.
#include <string>
#include <string_view>
#include <vector>

namespace softgrain::report {

/// `<name>text</name>` with the text escaped.
std::string element(std::string_view name, std::string_view text);

/// A cell of a table, or of a list of facts.
struct Cell {
    std::string markup;
    bool flagged = false;  ///< shown on a tint, after an exclamation mark
};
Cell text_cell(std::string_view text);

/// The first column is left-aligned, as are those named; all others hold numbers and are right-aligned.
struct Table {
    std::vector<std::string> header;      ///< plain text
    std::vector<std::vector<Cell>> rows;  ///< as long as the header
    std::vector<std::size_t> text_columns = {};
};
std::string table(const Table& table);

/// A name and what is said of it, line by line.
std::string facts(const std::vector<std::pair<std::string, Cell>>& lines);

/// `bytes` in base 64.
std::string base64(std::string_view bytes);

}  // namespace softgrain::report
