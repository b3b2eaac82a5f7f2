#pragma once
// A table of numbers with one header line, comma separated, as history.csv is.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace softgrain {

class CsvTable {
  public:
    /// Lines starting with # and empty lines are skipped; `nan` and empty cells are nan; a last
    /// line that is being written, short and without its end, is left out. Throws InputError with file and
    /// line.
    explicit CsvTable(std::filesystem::path path);

    bool has(std::string_view name) const;
    /// Throws InputError with the names there are.
    const std::vector<double>& column(std::string_view name) const;

  private:
    std::filesystem::path path_;
    std::vector<std::string> names_;
    std::vector<std::vector<double>> columns_;
};

}  // namespace softgrain
