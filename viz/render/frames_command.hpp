#pragma once
// softgrain-render frames: a picture for each run and loading stage, and all of them on one sheet.
#include <filesystem>
#include <string>
#include <vector>

#include "viz/render/shared_scale.hpp"

namespace softgrain {

struct FramesRequest {
    std::vector<std::string> runs;  ///< LABEL=RUN_DIR
    std::vector<double> at;         ///< fractions of the list of frames
    std::vector<double> at_packing_fraction;
    DrawingStyle style;
    std::filesystem::path out;
};

/// Writes OUT/LABEL_1.png ... for each run and stage, and OUT/sheet.png. Throws InputError, OutputError.
void draw_frames(const FramesRequest& request);

}  // namespace softgrain
