#pragma once
// One scale for many frames: their colours, metres and forces.
#include <filesystem>
#include <string>
#include <vector>

#include "viz/render/sheet.hpp"

namespace softgrain {

/// What is drawn of each frame, and how.
struct DrawingStyle {
    std::string field = "mean_stress";
    std::vector<double> range;   ///< empty, or min and max of the colours
    bool parts = false;          ///< draw what grains are made of, of the runs that wrote it
    std::vector<double> window;  ///< empty, or left, right, bottom, top as shares of the extent
    int width = 0;               ///< [pixels] 0: by the number of panels
};
/// Throws InputError naming the option.
void check_style(const DrawingStyle& style);

/// Looks at one frame after the other, and keeps no more of them than numbers.
class ScaleGatherer {
  public:
    /// `style` must outlive it.
    explicit ScaleGatherer(const DrawingStyle& style);
    /// Throws InputError if the frame does not have the field, naming the run.
    void add(const Frame& frame, const std::string& run);
    /// Throws InputError if the frames were empty.
    SheetScale scale() const;

  private:
    struct Forces {
        std::vector<double> values;  ///< [N]
        double diameter = 0.0, frames = 0.0;
    };
    static ForceScale of_forces(Forces forces, double strong, double widest);

    const DrawingStyle& style_;
    SheetScale scale_;
    std::vector<double> values_;
    Forces of_grains_, of_parts_;
};

}  // namespace softgrain
