#pragma once
// A scenario and two invented methods for the tests of the reader.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/errors.hpp"
#include "common/io/scenario_file.hpp"

namespace softgrain::test {

inline std::span<const MethodKeys> methods() {
    static const std::vector<KeySpec> spring_keys{
        {"law",
         KeyType::text,
         Value(std::string("linear")),
         "",
         "force law",
         any_number,
         {"linear", "hertz"}},
        {"damping", KeyType::number, 0.5, "1/s", "of the normal motion", not_negative},
        {"iterations", KeyType::integer, Value(std::int64_t{20}), "", "per step", Range{1.0, 1000.0}},
        {"rolling", KeyType::boolean, Value(true), "", "rolling resistance"},
        {"cutoff", KeyType::number, Value(), "m", "no force beyond", positive},
    };
    static const std::vector<KeySpec> glue_keys{
        {"strength", KeyType::number, 1.0, "N", "of a bond", positive},
    };
    const auto spring_faults = [](const Settings& spring) {
        std::vector<KeyFault> faults;
        if (spring.has("cutoff") && spring.text("law") == "linear")
            faults.push_back({"cutoff", "is for law = \"hertz\"; leave it out"});
        return faults;
    };
    static const std::vector<MethodKeys> all{{"spring", spring_keys, +spring_faults}, {"glue", glue_keys}};
    return all;
}

inline constexpr std::string_view stage = "[[loading]]\nuntil_strain = 0.1\nstrain_rate = 1e-3\n";

inline Scenario parse(std::string_view text, const std::vector<std::string>& overrides = {}) {
    return parse_scenario(text, "s.toml", overrides, methods());
}

/// The message of the InputError, "" if there is none.
inline std::string error_of(std::string_view text, const std::vector<std::string>& overrides = {}) {
    try {
        parse(text, overrides);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

}  // namespace softgrain::test
