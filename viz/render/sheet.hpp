#pragma once
// A page of panels on one scale: rows are runs, columns are loading stages.
#include <string>
#include <vector>

#include "viz/render/page.hpp"
#include "viz/render/panel.hpp"

namespace softgrain {

struct Sheet {
    std::vector<std::string> row_labels;            ///< [rows]
    std::vector<std::string> column_labels;         ///< [columns]
    std::vector<std::vector<const Frame*>> frames;  ///< [rows][columns]
};

/// What the panels share apart from the pixels, which follow from the page.
struct SheetScale {
    std::string field, unit;
    ColourRange colours{};
    ForceScale grain_forces, part_forces;  ///< none where no frame draws them
    Window window;
    Vec2 extent = Vec2::Zero();  ///< width and height of the largest extent shown [m]
    double no_stress = 0.0;      ///< a mean stress below this is rounding, shown as 0 [N/m]
};

Page lay_out_sheet(const Sheet& sheet, const SheetScale& scale, int width);

}  // namespace softgrain
