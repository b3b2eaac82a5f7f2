#pragma once
// Lists in plans: texts with commas.
#include <string>
#include <string_view>
#include <vector>

namespace softgrain::bench {

/// Without the spaces around it.
std::string trimmed(std::string_view text);
/// The words between commas, without empty ones.
std::vector<std::string> parts(std::string_view text);

}  // namespace softgrain::bench
