#include "viz/render/graphics.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "common/errors.hpp"

namespace softgrain {

std::unique_ptr<Graphics> open_graphics() {
    const char* variable = std::getenv("SOFTGRAIN_RENDER");
    const std::string_view wanted = variable == nullptr ? "" : variable;
    if (wanted == "egl") return open_egl_graphics();
    if (wanted == "xvfb") return open_xvfb_graphics();
    if (!wanted.empty())
        throw InputError(fmt::format("SOFTGRAIN_RENDER is '{}'; it can be egl or xvfb", wanted));
    try {
        return open_egl_graphics();
    } catch (const OutputError& without_egl) {
        try {
            return open_xvfb_graphics();
        } catch (const OutputError& without_xvfb) {
            throw OutputError(
                fmt::format("no off-screen graphics: {}; {}; install libegl1 and libgl1-mesa-dri, or xvfb",
                            without_egl.what(), without_xvfb.what()));
        }
    }
}

}  // namespace softgrain
