#pragma once
// Numbers and lists as a reader wants them.
#include <string>
#include <vector>

namespace softgrain::report {

inline constexpr const char* no_number = "\u2013";

std::string percent(double share);           ///< 0.0123 is "1.2 %", 1.5 is "150 %"
std::string whole_percent(double share);     ///< 0.02 is "2 %"
std::string seconds(double time);            ///< "0.34 s"
std::string significant(double value);       ///< three digits
std::string packing_fraction(double value);  ///< three decimals
std::string whole(long long value);          ///< "17 519", by thin spaces that do not break
/// "12 times less", "about the same": of `a` beside `b`, both > 0.
std::string times_less(double a, double b);
std::string listed(const std::vector<std::string>& words);  ///< "a, b and c"

}  // namespace softgrain::report
