#include "viz/render/pictures_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <optional>
#include <regex>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "viz/render/film.hpp"
#include "viz/render/graphics.hpp"
#include "viz/render/loading_path.hpp"
#include "viz/render/run_list.hpp"

namespace softgrain {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_columns = 4;
constexpr double film_rate = 25.0, shortest_film = 5.0, slowest_rate = 2.0;  ///< [1/s], [s], [1/s]

/// A picture to be made.
struct Stage {
    std::string name;  ///< for its file
    double at;         ///< on the loading path
};

/// The share of the loading that a word of --at asks for.
double fraction_of(const std::string& word) {
    double value = -1.0;
    const char* end = word.data() + word.size();
    const auto parsed = std::from_chars(word.data(), end, value);
    if (parsed.ec != std::errc{} || parsed.ptr != end || !(value >= 0.0 && value <= 1.0))
        throw InputError(fmt::format("--at {}: can be first, last, all, or numbers from 0 to 1", word));
    return value;
}

bool asks_for_all(const PicturesRequest& request) {
    return request.film || std::ranges::find(request.at, "all") != request.at.end();
}

void check(const PicturesRequest& request) {
    check_style(request.style);
    const bool some_at = !request.at.empty() && request.at != std::vector<std::string>{"all"};
    if (request.film && (some_at || !request.at_packing_fraction.empty()))
        throw InputError("--film shows the whole loading; it goes with no other --at than all");
    if (asks_for_all(request) && request.at.size() > 1)
        throw InputError("--at all: goes with no other stage");
    for (const double at : request.at_packing_fraction)
        if (!(at > 0.0 && at < 2.0)) throw InputError(fmt::format("--at-phi {}: must be 0 to 2", at));
    if (request.fps != 0.0 && !(request.fps >= 0.1 && request.fps <= 240.0))
        throw InputError("--fps: must be 0.1 to 240");
    if (request.out.extension() == ".mp4" && !request.film)
        throw InputError(fmt::format("--out {}: a film needs --film", request.out.string()));
    if (request.out.extension() == ".png" &&
        (asks_for_all(request) || std::max(request.at.size(), request.at_packing_fraction.size()) > 1))
        throw InputError(
            fmt::format("--out {}: is one picture; give a folder for several", request.out.string()));
}

std::vector<Stage> stages_of(const PicturesRequest& request, const LoadingPath& path) {
    std::vector<Stage> stages;
    for (const double phi : request.at_packing_fraction) stages.push_back({fmt::format("phi_{}", phi), phi});
    if (!stages.empty()) return stages;
    if (asks_for_all(request)) {
        for (const double at : path.all_stages())
            stages.push_back({fmt::format("frame_{:04}", stages.size()), at});
        return stages;
    }
    for (const std::string& word : request.at.empty() ? std::vector<std::string>{"last"} : request.at) {
        if (word == "first")
            stages.push_back({word, path.start()});
        else if (word == "last")
            stages.push_back({word, path.last_common()});
        else
            stages.push_back({word, path.start() + fraction_of(word) * (path.end() - path.start())});
    }
    return stages;
}

/// Where pictures go and what they are called.
class Places {
  public:
    explicit Places(const PicturesRequest& request)
        : name_(request.style.field + (request.style.parts ? "_parts" : "")), out_(request.out) {
        if (out_.empty()) {
            fs::path first = request.runs[0];
            if (!fs::is_directory(first)) first = labelled_run(request.runs[0], "RUN").folder;
            out_ = first / "pictures";
        }
        for (char& c : name_)
            if (c == '/') c = '_';
    }
    fs::path picture(const Stage& stage) const {
        return out_.extension() == ".png" ? out_ : out_ / fmt::format("{}_{}.png", name_, stage.name);
    }
    fs::path frames_folder() const {
        return out_.extension() == ".mp4" ? fs::path(out_).replace_extension().concat("_frames")
                                          : out_ / (name_ + "_frames");
    }
    fs::path film() const { return out_.extension() == ".mp4" ? out_ : out_ / (name_ + ".mp4"); }

  private:
    std::string name_;
    fs::path out_;
};

/// The frames of the runs, of each the last one kept: a run that has ended stays at its last.
class Frames {
  public:
    Frames(const std::vector<RunReader>& runs, bool parts) : runs_(runs), parts_(parts), kept_(runs.size()) {}

    const Frame& get(std::size_t run, std::size_t frame) {
        if (!kept_[run] || kept_[run]->number != frame)
            kept_[run] = Kept{frame, runs_[run].read(frame, parts_)};
        return kept_[run]->frame;
    }

  private:
    struct Kept {
        std::size_t number;
        Frame frame;
    };
    const std::vector<RunReader>& runs_;
    bool parts_;
    std::vector<std::optional<Kept>> kept_;
};

/// Looks at each frame once.
SheetScale common_scale(const PicturesRequest& request, const std::vector<RunReader>& runs,
                        const LoadingPath& path, const std::vector<Stage>& stages, Frames& frames) {
    ScaleGatherer gatherer(request.style);
    for (std::size_t r = 0; r < runs.size(); ++r) {
        std::vector<bool> seen(runs[r].frame_count(), false);
        for (const Stage& stage : stages) {
            const std::size_t frame = path.match(r, stage.at).frame;
            if (!seen[frame]) gatherer.add(frames.get(r, frame), runs[r].label());
            seen[frame] = true;
        }
    }
    return gatherer.scale();
}

/// Four in a row, more in a square; as few as keep the number of rows.
std::size_t columns_for(std::size_t panels) {
    std::size_t columns = std::min(panels, most_columns);
    while (columns * columns < panels) ++columns;
    const std::size_t rows = (panels + columns - 1) / columns;
    return (panels + rows - 1) / rows;
}

int width_for(std::size_t columns) {
    return columns == 1 ? 1080 : columns == 2 ? 1600 : 1920;
}

Sheet sheet_at(const Stage& stage, const std::vector<RunReader>& runs, const LoadingPath& path,
               std::size_t columns, Frames& frames) {
    Sheet sheet;
    sheet.one_stage = true;
    for (std::size_t r = 0; r < runs.size(); ++r) {
        if (r % columns == 0) sheet.cells.emplace_back();
        const auto [frame, beyond_end] = path.match(r, stage.at);
        const char* ending = !beyond_end ? "" : runs[r].has_ended() ? "ended at" : "so far to";
        sheet.cells.back().push_back({&frames.get(r, frame), runs[r].label(), ending});
    }
    return sheet;
}

void remove_earlier_frames(const fs::path& folder) {
    static const std::regex frame("frame_[0-9]+\\.png");
    if (!fs::is_directory(folder)) return;
    std::vector<fs::path> earlier;
    for (const auto& entry : fs::directory_iterator(folder))
        if (std::regex_match(entry.path().filename().string(), frame)) earlier.push_back(entry.path());
    for (const fs::path& path : earlier) fs::remove(path);
}

double rate_of(const PicturesRequest& request, std::size_t pictures) {
    if (request.fps > 0.0) return request.fps;
    return std::clamp(static_cast<double>(pictures) / shortest_film, slowest_rate, film_rate);
}

void film(const PicturesRequest& request, const Places& places, std::size_t pictures) {
    const FilmFrames frames{places.frames_folder(), rate_of(request, pictures)};
    if (find_ffmpeg().empty()) {
        fmt::print(stderr, "no film: ffmpeg is not installed; with it: {}\n",
                   film_command(frames, places.film()));
        return;
    }
    make_film(frames, places.film());
    fmt::print("{}\n", places.film().string());
}

/// Which stage `last` was, if one of the runs is the reason.
void explain_last(const std::vector<RunReader>& runs, const LoadingPath& path) {
    std::string short_ones;
    for (std::size_t r = 0; r < runs.size(); ++r)
        if (path.match(r, path.end()).beyond_end)
            short_ones += (short_ones.empty() ? "" : ", ") + runs[r].label();
    if (!short_ones.empty())
        fmt::print("the last stage of all runs is {} {:.4g} ({} went no farther); --at 1 shows the end\n",
                   path.quantity(), path.last_common(), short_ones);
}

}  // namespace

void draw_pictures(const PicturesRequest& request) {
    check(request);
    std::vector<RunReader> runs;
    for (const NamedRun& run : find_runs(request.runs)) runs.emplace_back(run.label, run.folder);
    const LoadingPath path(runs, !request.at_packing_fraction.empty());
    const auto stages = stages_of(request, path);
    Frames frames(runs, request.style.parts);
    const SheetScale scale = common_scale(request, runs, path, stages, frames);
    const std::size_t columns = columns_for(runs.size());
    const int width = request.style.width == 0 ? width_for(columns) : request.style.width;
    const auto graphics = open_graphics();
    const Places places(request);
    const bool numbered = asks_for_all(request);
    if (numbered) remove_earlier_frames(places.frames_folder());
    for (const Stage& stage : stages) {
        const Page page = lay_out_sheet(sheet_at(stage, runs, path, columns, frames), scale, width);
        const fs::path out =
            numbered ? places.frames_folder() / (stage.name + ".png") : places.picture(stage);
        make_directories(fs::absolute(out).parent_path());
        write_png(out, *page.draw(*graphics));
        fmt::print("{}\n", out.string());
        std::fflush(stdout);
        if (stage.name == "last") explain_last(runs, path);
    }
    if (request.film) film(request, places, stages.size());
}

}  // namespace softgrain
