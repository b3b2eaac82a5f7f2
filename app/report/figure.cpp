#include "app/report/figure.hpp"

#include "common/errors.hpp"
#include "viz/plot_data.hpp"
#include "viz/plot_svg.hpp"

namespace softgrain::report {
namespace {

constexpr int width = 720, height = 540;  ///< [pixels]
constexpr double letters = 1.25;          ///< two plots share the width of the page

}  // namespace

std::string figures(std::vector<PlotSpec> plots) {
    std::string out = "<div class=\"plots\">\n";
    for (PlotSpec& plot : plots) {
        plot.width = width;
        plot.height = height;
        try {
            load_plot_data(plot, ".");
        } catch (const InputError&) {
            continue;
        }
        out += "<figure>" + plot_svg(plot, letters) + "</figure>\n";
    }
    return out + "</div>\n";
}

}  // namespace softgrain::report
