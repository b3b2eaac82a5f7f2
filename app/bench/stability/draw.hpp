#pragma once
// Random scenarios by the schema: which keys and what values, from a seed.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace softgrain::bench {

/// A scenario that the reader accepts, and what it said of those that it did not.
struct DrawnScenario {
    std::string text;                  ///< TOML
    std::vector<std::string> refused;  ///< messages of the reader for the draws before it
};

/// A small scenario for this method, the same for the same seed. Every key of every table may be in it, with
/// a value out of its range; lengths, stresses, densities, times and rates are drawn about random units, so
/// that a run has some thousand steps at most. Throws std::logic_error if the reader accepts none of many.
DrawnScenario draw_scenario(std::uint64_t seed, std::string_view method);

}  // namespace softgrain::bench
