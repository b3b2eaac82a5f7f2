#pragma once
// softgrain render RUN...: runs side by side at the same loading, as pictures or as a film.
#include <filesystem>
#include <string>
#include <vector>

#include "viz/render/shared_scale.hpp"

namespace softgrain {

struct PicturesRequest {
    std::vector<std::string> runs;            ///< RUN_DIR, LABEL=RUN_DIR or the folder of a comparison
    std::vector<std::string> at;              ///< first, last, all, or fractions of the loading; none: last
    std::vector<double> at_packing_fraction;  ///< used instead of `at` if not empty
    DrawingStyle style;
    bool film = false;
    double fps = 0.0;  ///< pictures per second of a film; 0: 25, fewer if the film would be over in no time
    std::filesystem::path
        out;  ///< folder, or a file .png or .mp4; empty: `pictures` in the first run's folder
};

/// Writes the pictures and prints their paths. Throws InputError, OutputError.
void draw_pictures(const PicturesRequest& request);

}  // namespace softgrain
