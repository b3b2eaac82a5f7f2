#include "viz/render/film.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "common/errors.hpp"
#include "viz/run_program.hpp"

namespace softgrain {
namespace fs = std::filesystem;
namespace {

constexpr double smoothest = 25.0;  ///< players show films of fewer pictures per second with delays

/// ffmpeg's pattern of the pictures' names, in which a % of the folder is doubled.
std::string pattern(const fs::path& folder) {
    std::string text;
    for (const char c : folder.string()) text += c == '%' ? std::string("%%") : std::string(1, c);
    return fs::path(text) / "frame_%04d.png";
}

std::vector<std::string> arguments(const std::string& ffmpeg, const FilmFrames& frames, const fs::path& out) {
    const auto rate = [](double value) { return fmt::format("{:.6g}", value); };
    const std::string even_size = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";
    const double shown = std::max(smoothest, frames.pictures_per_second);
    return {ffmpeg,       "-y",
            "-nostdin",   "-loglevel",
            "error",  //
            "-framerate", rate(frames.pictures_per_second),
            "-i",         pattern(frames.folder),  //
            "-vf",        even_size,
            "-c:v",       "libx264",
            "-pix_fmt",   "yuv420p",
            "-r",         rate(shown),  //
            "-movflags",  "+faststart",
            "-f",         "mp4",
            out.string()};
}

/// Lets Ctrl-C end ffmpeg and not us, so that the user is told what is there.
class OutliveInterrupt {
  public:
    OutliveInterrupt() : before_(std::signal(SIGINT, [](int) {})) {}
    OutliveInterrupt(const OutliveInterrupt&) = delete;
    OutliveInterrupt& operator=(const OutliveInterrupt&) = delete;
    ~OutliveInterrupt() { std::signal(SIGINT, before_); }

  private:
    void (*before_)(int);
};

}  // namespace

fs::path find_ffmpeg() {
    return find_on_path("ffmpeg");
}

std::string film_command(const FilmFrames& frames, const fs::path& out) {
    return fmt::format("{}", fmt::join(arguments("ffmpeg", frames, out), " "));
}

void make_film(const FilmFrames& frames, const fs::path& out) {
    const fs::path aside = out.string() + ".part";
    std::optional<std::string> failure;
    {
        const OutliveInterrupt guard;
        failure = run_program(arguments(find_ffmpeg().string(), frames, aside));
    }
    std::error_code error;
    if (!failure) fs::rename(aside, out, error);
    if (error) failure = error.message();
    fs::remove(aside, error);
    if (failure) std::ranges::replace(*failure, '\n', ' ');
    if (failure)
        throw OutputError(fmt::format("{}: ffmpeg could not make the film: {}; the pictures are in {}",
                                      out.string(), *failure, frames.folder.string()));
}

}  // namespace softgrain
