#pragma once
// What `softgrain bench error` runs and what it measures against, from a TOML file (bench/error/README.md).
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/expression.hpp"

namespace softgrain::bench {

/// What is compared, in the order of all tables.
inline constexpr std::size_t quantity_count = 4;
struct QuantityName {
    const char* key;    ///< in the plan and in error.csv
    const char* title;  ///< in tables and plots
};
inline constexpr std::array<QuantityName, quantity_count> quantity_names{{{"stress", "mean stress"},
                                                                          {"coordination", "Z"},
                                                                          {"deviatoric", "deviatoric stress"},
                                                                          {"area", "loss of grain area"}}};
inline constexpr std::size_t stress = 0;  ///< the quantity that decides

/// The same quantity of a run and of the reference.
struct Quantity {
    Expression run, reference;
    std::optional<Expression> error;  ///< the reference's own, of the same size in its columns
    std::optional<Expression> scale;  ///< of the reference, what errors are relative to; itself if not given
};

struct Case {
    std::string name, title;
    std::filesystem::path scenario, reference;
    std::vector<std::string> set;         ///< KEY=VALUE
    Expression run_over, reference_over;  ///< what the loading increases
    std::array<std::optional<Quantity>, quantity_count> quantities;
    std::optional<History> truth;  ///< the reference; none if its file is not there
};

/// One point of a sweep.
struct Setting {
    std::string method, knob;
    std::string label;               ///< "inertial_number = 1e-3", or the name of a knob without key
    std::vector<std::string> set;    ///< KEY=VALUE
    std::vector<std::string> cases;  ///< names; empty for all
    int line = 0;                    ///< in the plan

    bool is_for(const Case& one) const;
    std::string name() const;  ///< "loading rate, inertial_number = 1e-3"
};

/// A ratio to print: the cheapest setting of a method within an error beside the last one of a knob.
struct Headline {
    std::string case_name, method, against;
    double error, times;
};

struct Plan {
    std::filesystem::path source;
    std::vector<Case> cases;
    std::vector<Setting> settings;
    std::vector<Headline> headlines;
};

/// Paths in it are looked up from its folder. Throws InputError: a line for each error, with place.
Plan read_plan(const std::filesystem::path& path);

}  // namespace softgrain::bench
