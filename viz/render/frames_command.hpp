#pragma once
// softgrain-render frames: runs at the same loading stages, on one scale.
#include <filesystem>
#include <string>
#include <vector>

namespace softgrain {

struct FramesRequest {
    std::vector<std::string> runs;  ///< LABEL=RUN_DIR
    std::vector<double> at;         ///< fractions of the list of frames
    std::vector<double> at_packing_fraction;
    std::string field = "mean_stress";
    std::vector<double> range;   ///< empty, or min and max of the colours
    bool parts = false;          ///< draw what grains are made of, of the runs that wrote it
    std::vector<double> window;  ///< empty, or left, right, bottom, top as shares of the extent
    std::filesystem::path out;
    int width = 1600;  ///< [pixels]
};

/// Writes OUT/LABEL_1.png ... for each run and stage, and OUT/sheet.png. Throws InputError, OutputError.
void draw_frames(const FramesRequest& request);

}  // namespace softgrain
