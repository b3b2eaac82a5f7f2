#pragma once
// Pictures made by softgrain-render in a process of its own, with each kind of off-screen graphics.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "hand_made_grains.hpp"
#include "picture.hpp"
#include "viz/client.hpp"

namespace softgrain {

class Rendering : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        ::setenv("SOFTGRAIN_RENDER_EXE", SOFTGRAIN_RENDER_EXE, 1);
        ::setenv("SOFTGRAIN_RENDER", GetParam(), 1);
        ::unsetenv("DISPLAY");
        // For the child, if built with the address sanitizer: drivers that Mesa unloads leave 56 bytes each.
        ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
    }
    /// A machine may lack one kind of graphics; the renderer then says so before it draws.
    bool missing(const std::optional<std::string>& error) const {
        if (!error) return false;
        for (const char* what : {"EGL:", "Xvfb:", "no off-screen graphics:"})
            if (error->find(std::string("softgrain-render: ") + what) == 0) return true;
        return false;
    }
    TemporaryFolder folder;
};

/// From metres to pixels on a picture of one panel, from the corners of its walls: the outermost black frame.
struct PanelOnPicture {
    double scale, left, bottom;

    PanelOnPicture(const Picture& picture, const Box& box) {
        const auto dark = [&](int x, int y) { return is_near(picture.pixel(x, y), black, 60); };
        const auto dark_in_column = [&](int x) {
            int count = 0;
            for (int y = 0; y < picture.height(); ++y) count += dark(x, y) ? 1 : 0;
            return count > picture.height() / 3;
        };
        int x_low = 0, x_high = picture.width() - 1;
        while (x_low < x_high && !dark_in_column(x_low)) ++x_low;
        while (x_low < x_high && !dark_in_column(x_high)) --x_high;
        scale = (x_high - x_low + 1 - 2 * wall) / box.width();
        left = x_low + wall;
        int y_low = 0;
        while (y_low < picture.height() - 1 && !dark_run(picture, x_low, x_high, y_low)) ++y_low;
        bottom = y_low + wall;
    }
    std::array<int, 2> at(const Box& box, const Vec2& x) const {
        return {static_cast<int>(std::lround(left + scale * (x.x() - box.position[0]))),
                static_cast<int>(std::lround(bottom + scale * (x.y() - box.position[2])))};
    }

  private:
    static constexpr int wall = 4;  ///< width of its line [pixels]
    static bool dark_run(const Picture& picture, int x_low, int x_high, int y) {
        for (int x = x_low; x <= x_high; ++x)
            if (!is_near(picture.pixel(x, y), black, 60)) return false;
        return true;
    }
};

}  // namespace softgrain
