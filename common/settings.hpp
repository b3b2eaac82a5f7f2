#pragma once
// Keys of a scenario table: declared once, then used for validation, defaults, help and the resolved file.
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace softgrain {

/// std::monostate stands for "not given and without a default".
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

enum class KeyType { boolean, integer, number, text };

/// Allowed interval of a number or integer.
struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool open_min = false;  ///< min itself is not allowed
    bool open_max = false;
};
inline constexpr Range any_number{};
inline constexpr Range positive{0.0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Range not_negative{0.0, std::numeric_limits<double>::infinity(), false, false};

/// One key of a table. A key with `monostate` default is optional.
struct KeySpec {
    std::string_view name;
    KeyType type;
    Value default_value;
    std::string_view unit;  ///< "" if none
    std::string_view help;
    Range range = any_number;
    std::vector<std::string_view> choices = {};  ///< for text; empty allows any
};

/// A value that does not go with the others of its table, and what to do about it.
struct KeyFault {
    std::string_view key;
    std::string message;
};

/// Validated values of one table, defaults filled in.
class Settings {
  public:
    Settings() = default;
    /// Every key at its default.
    explicit Settings(std::span<const KeySpec> keys);

    bool has(std::string_view name) const;  ///< given, or with a default
    double number(std::string_view name) const;
    std::int64_t integer(std::string_view name) const;
    bool boolean(std::string_view name) const;
    const std::string& text(std::string_view name) const;
    void set(std::string_view name, Value value);
    const std::map<std::string, Value, std::less<>>& values() const { return values_; }

  private:
    std::map<std::string, Value, std::less<>> values_;
};

}  // namespace softgrain
