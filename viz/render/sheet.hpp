#pragma once
// A page of panels on one scale.
#include <string>
#include <vector>

#include "viz/render/page.hpp"
#include "viz/render/panel.hpp"

namespace softgrain {

/// One panel of a sheet.
struct Cell {
    const Frame* frame;
    std::string title;  ///< above the panel, or ""
    std::string
        ending;  ///< "" or why the frame is not at the stage of the others, before its packing fraction
};

struct Sheet {
    std::string heading;                     ///< above all panels, or ""
    std::vector<std::string> row_labels;     ///< [rows], or none
    std::vector<std::string> column_labels;  ///< [columns], or none
    std::vector<std::vector<Cell>> cells;    ///< [rows][columns]; the last row may be shorter
    /// Captions stay where they are when boxes shrink, and say the time: for panels that do not know of other
    /// stages.
    bool one_stage = false;
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
