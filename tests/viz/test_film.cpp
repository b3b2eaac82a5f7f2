// Films, with and without ffmpeg.
#include <fmt/format.h>

#include "render_program.hpp"
#include "viz/render/film.hpp"

namespace softgrain {
namespace {
namespace fs = std::filesystem;

class Film : public RenderProgram {
  protected:
    void SetUp() override {
        RenderProgram::SetUp();
        write_hand_made_run(path_of("run"), 2, 3);
    }
    std::string film() const { return path_of("run") + " --film --width 401 --out " + path_of("film.mp4"); }
    /// A program named ffmpeg that does this, alone on the path but for the shell's.
    std::string with_ffmpeg(const std::string& script) const {
        const fs::path program = folder.path() / "bin/ffmpeg";
        fs::create_directories(program.parent_path());
        std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
        fs::permissions(program, fs::perms::owner_all);
        return "PATH=" + program.parent_path().string();
    }
    bool frames_are_there() const {
        return fs::exists(path_of("film_frames/frame_0000.png")) &&
               fs::exists(path_of("film_frames/frame_0002.png"));
    }
    bool no_film_is_there() const {
        return !fs::exists(path_of("film.mp4")) && !fs::exists(path_of("film.mp4.part"));
    }
};

TEST_P(Film, IsMadeByFfmpeg) {
    if (find_ffmpeg().empty()) GTEST_SKIP() << "ffmpeg is not installed";
    const auto made = render(film());
    if (missing_graphics(made)) GTEST_SKIP() << made.err;
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NE(made.out.find(path_of("film.mp4") + "\n"), std::string::npos) << made.out;
    EXPECT_TRUE(frames_are_there());
    // Read back: the last picture, its odd width made even, and 25 frames a second for 3 pictures at 2 a
    // second.
    const std::string back = find_ffmpeg().string() + " -loglevel error -i " + path_of("film.mp4");
    ASSERT_EQ(std::system((back + " " + path_of("back_%04d.png")).c_str()), 0);
    const Picture picture(path_of("back_0001.png"));
    EXPECT_EQ(picture.width(), 402);
    EXPECT_EQ(picture.height() % 2, 0);
    EXPECT_LT(picture.share_of(white, 8), 0.9);
    int frames = 0;
    while (fs::exists(path_of(fmt::format("back_{:04}.png", frames + 1)))) ++frames;
    EXPECT_NEAR(frames, 37.5, 2);
}

TEST_P(Film, WithoutFfmpegThePicturesAreLeft) {
    const auto made = render(film(), "PATH=/nowhere");
    if (missing_graphics(made)) GTEST_SKIP() << made.err;
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_TRUE(frames_are_there());
    EXPECT_TRUE(no_film_is_there());
    EXPECT_NE(made.err.find("no film: ffmpeg is not installed"), std::string::npos) << made.err;
    EXPECT_EQ(std::count(made.err.begin(), made.err.end(), '\n'), 1) << made.err;
}

TEST_P(Film, AFailedFfmpegLeavesThePicturesAndNoHalfFilm) {
    for (const std::string script :
         {"for last; do :; done; echo half > \"$last\"; echo bad codec >&2; exit 1", "kill -9 $$"}) {
        const auto failed = render(film(), with_ffmpeg(script));
        if (missing_graphics(failed)) GTEST_SKIP() << failed.err;
        EXPECT_EQ(failed.exit_code, 4);
        EXPECT_NE(failed.err.find("film.mp4: ffmpeg could not make the film: "), std::string::npos)
            << failed.err;
        EXPECT_NE(failed.err.find(script[0] == 'k' ? "ended by signal 9" : "bad codec"), std::string::npos)
            << failed.err;
        EXPECT_TRUE(frames_are_there());
        EXPECT_TRUE(no_film_is_there());
    }
}

INSTANTIATE_TEST_SUITE_P(Graphics, Film, testing::Values(""), [](const auto&) { return std::string("any"); });

}  // namespace
}  // namespace softgrain
