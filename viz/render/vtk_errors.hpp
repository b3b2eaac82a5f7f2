#pragma once
// VTK reports errors as text on the terminal and goes on; here they end the program's work instead.
#include <string>

namespace softgrain {

/// Collects VTK's messages from now on instead of printing them.
void collect_vtk_errors();

/// The first error since the last call, or "".
std::string take_vtk_error();

}  // namespace softgrain
