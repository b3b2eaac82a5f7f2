#pragma once
// What the readers of plans (TOML files of tables [[name]]) share.
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/scenario_document.hpp"
#include "common/io/scenario_table.hpp"

namespace softgrain::bench {

/// A key without default.
KeySpec text_key(std::string_view name);

std::string trimmed(std::string_view text);

/// The words between commas.
std::vector<std::string> parts(std::string_view text);

class PlanReader {
  public:
    /// Throws InputError if the file cannot be read or is no TOML.
    explicit PlanReader(const std::filesystem::path& path);

  protected:
    ~PlanReader() = default;
    using CheckedTable = scenario_io::CheckedTable;

    /// Other tables of the document are errors.
    void known_tables(const std::vector<std::string_view>& names);
    /// At least one of these tables must be there.
    void needed(std::string_view name);
    /// The sound ones of [[name]]; `required` are keys that must be there.
    std::vector<CheckedTable> tables(std::string_view name, const std::vector<KeySpec>& keys,
                                     std::initializer_list<std::string_view> required);
    /// The one table [name]; its defaults if it is not there.
    CheckedTable table(std::string_view name, const std::vector<KeySpec>& keys);
    /// "" if it is not given.
    static std::string text(const CheckedTable& table, std::string_view key);
    /// A path, looked up from the plan's folder.
    std::filesystem::path file(const CheckedTable& table, std::string_view key) const;
    void add_error(const CheckedTable& table, std::string_view key, std::string_view what);
    /// Whether the key `method` names one; an error if not.
    bool is_method(const CheckedTable& table);

    const std::filesystem::path path_;
    scenario_io::ErrorList errors_;

  private:
    void known(const scenario_io::Node& node, const std::vector<std::string_view>& words);
    CheckedTable check(const scenario_io::Node* node, const std::string& name,
                       const std::vector<KeySpec>& keys);

    scenario_io::Node document_;
};

}  // namespace softgrain::bench
