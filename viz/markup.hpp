#pragma once
// Text within XML or HTML.
#include <string>
#include <string_view>

namespace softgrain {

/// The text with & < > " ' as entities, fit for an element or a quoted attribute. Control characters that XML
/// does not allow become spaces.
std::string escape_markup(std::string_view text);

}  // namespace softgrain
