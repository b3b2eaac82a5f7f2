#pragma once
// The grains of all methods, stage by stage of the loading, on one colour scale.
#include <filesystem>
#include <string>
#include <vector>

#include "app/comparison_table.hpp"

namespace softgrain::report {

/// One stage: PNG files of the methods, as they are among the results; empty where a run has no pictures.
struct PictureStage {
    std::string name;               ///< "packing fraction 0.84"
    std::vector<std::string> png;   ///< [results] bytes
    std::vector<std::string> note;  ///< [results] plain text below the picture, may be empty
};

struct Pictures {
    std::vector<PictureStage> stages;  ///< in the order of the loading
    std::string failure;               ///< why there are none
};

/// Draws with softgrain-render, smaller or fewer if they come to more than `most_bytes`. Failure is said, not
/// thrown.
Pictures draw_pictures(const std::vector<MethodResult>& results, const std::filesystem::path& folder,
                       bool parts, std::size_t most_bytes);

/// With a slider; without scripts, and in print, the last stage.
std::string pictures_section(const std::vector<MethodResult>& results, const Pictures& pictures);

}  // namespace softgrain::report
