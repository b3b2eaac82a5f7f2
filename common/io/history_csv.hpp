#pragma once
// history.csv: one header line of names, then a row per sample, SI units.
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "common/observer.hpp"

namespace softgrain {

/// Appends each sample as it comes, so that a run can be followed while it goes.
class HistoryWriter final : public Observer {
  public:
    /// Starts the file anew with these rows (none, or those of a run that goes on).
    HistoryWriter(std::filesystem::path path, const std::vector<std::vector<double>>& rows);
    Need need(const Sample&) const override { return Need::base; }
    void observe(const GrainView& view, const Sample& sample) override;

  private:
    std::filesystem::path path_;
    std::ofstream file_;
};

/// A history read back: columns by name.
struct History {
    std::map<std::string, std::vector<double>, std::less<>> columns;

    std::size_t rows() const { return columns.empty() ? 0 : columns.begin()->second.size(); }
    /// Throws InputError if there is no such column.
    const std::vector<double>& column(std::string_view name) const;
};

/// Comment lines before the header start with '#'. Throws InputError naming file and line.
History read_history(const std::filesystem::path& path);

}  // namespace softgrain
