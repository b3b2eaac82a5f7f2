#pragma once
// Numbered pictures as a film, by ffmpeg.
#include <filesystem>
#include <string>

namespace softgrain {

struct FilmFrames {
    std::filesystem::path folder;  ///< holds frame_0000.png ... and no others of that kind
    double pictures_per_second;
};

/// Path of ffmpeg, empty if it is not installed.
std::filesystem::path find_ffmpeg();

/// The command that makes the film, as a user would type it.
std::string film_command(const FilmFrames& frames, const std::filesystem::path& out);

/// Writes an MP4 (H.264). Throws OutputError with the cause; the frames stay and a half-written film does
/// not.
void make_film(const FilmFrames& frames, const std::filesystem::path& out);

}  // namespace softgrain
