#include "app/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "viz/markup.hpp"

namespace softgrain::report {

std::string element(std::string_view name, std::string_view text) {
    return fmt::format("<{0}>{1}</{0}>\n", name, escape_markup(text));
}

Cell text_cell(std::string_view text) {
    return {escape_markup(text), false};
}

std::string table(const Table& table) {
    const auto css_class = [&](std::size_t column) -> std::string_view {
        const bool is_text = column == 0 || std::ranges::count(table.text_columns, column) > 0;
        return is_text ? "" : " class=\"number\"";
    };
    std::string out = "<div class=\"wide\"><table>\n<thead><tr>";
    for (std::size_t c = 0; c < table.header.size(); ++c)
        out += fmt::format("<th scope=\"col\"{}>{}</th>", css_class(c), escape_markup(table.header[c]));
    out += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
        out += "<tr>";
        for (std::size_t c = 0; c < row.size(); ++c) {
            const std::string content =
                row[c].flagged ? fmt::format("<strong class=\"flag\">! {}</strong>", row[c].markup)
                               : row[c].markup;
            out += c == 0 ? fmt::format("<th scope=\"row\">{}</th>", content)
                          : fmt::format("<td{}>{}</td>", css_class(c), content);
        }
        out += "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

std::string facts(const std::vector<std::pair<std::string, Cell>>& lines) {
    std::string out = "<dl>\n";
    for (const auto& [name, cell] : lines)
        out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape_markup(name), cell.markup);
    return out + "</dl>\n";
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve(bytes.size() / 3 * 4 + 4);
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        const std::size_t length = std::min<std::size_t>(3, bytes.size() - k);
        std::uint32_t word = 0;
        for (std::size_t b = 0; b < 3; ++b)
            word = word << 8U | (b < length ? static_cast<unsigned char>(bytes[k + b]) : 0U);
        for (std::size_t d = 0; d < 4; ++d) out += d <= length ? digits[word >> (18U - 6U * d) & 63U] : '=';
    }
    return out;
}

}  // namespace softgrain::report
