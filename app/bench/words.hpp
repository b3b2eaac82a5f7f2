#pragma once
// Numbers and texts of the benches' files.
#include <string>

namespace softgrain::bench {

/// A cell of a CSV file that may hold commas and quotes.
std::string quoted(std::string text);

/// Two digits, as little is known of a CPU time: 310, 1.2.
std::string two_digits(double ratio);

}  // namespace softgrain::bench
