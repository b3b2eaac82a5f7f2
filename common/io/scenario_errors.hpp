#pragma once
// All errors of one scenario, each with its place, thrown together.
#include <string>
#include <string_view>
#include <vector>

namespace softgrain::scenario_io {

/// Where a key or value was written: a line and column of the file, or an option `--set KEY=VALUE`.
struct Place {
    int line = 1;        ///< from 1; for an option its position among the options
    int column = 1;      ///< from 1
    std::string option;  ///< KEY of the option, empty for the file
};

class ErrorList {
  public:
    /// `name` stands before line and column: the file as the user named it.
    explicit ErrorList(std::string name) : name_(std::move(name)) {}

    /// `subject` is the full key ("material.density"), `text` what is wrong with it.
    void add(const Place& place, std::string_view subject, std::string_view text);

    std::size_t size() const { return entries_.size(); }

    /// Throws InputError with one line for each error: the file's first, by position, then the options'.
    void throw_if_any() const;

  private:
    struct Entry {
        Place place;
        std::string text;
    };
    std::string name_;
    std::vector<Entry> entries_;
};

}  // namespace softgrain::scenario_io
