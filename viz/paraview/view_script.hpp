#pragma once
// The script that opens results in ParaView (viz/paraview/view.py), written beside them.
#include <filesystem>
#include <string>
#include <vector>

namespace softgrain {

/// Writes folder/view.py, which opens these runs side by side. `runs`: their folders relative to `folder`.
/// Throws OutputError.
void write_view_script(const std::filesystem::path& folder, const std::vector<std::string>& runs);

}  // namespace softgrain
