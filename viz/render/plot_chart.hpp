#pragma once
// A plot spec as a VTK chart.
#include <vtkChartXY.h>
#include <vtkSmartPointer.h>

#include "viz/plot_spec.hpp"

namespace softgrain {

/// The chart of a spec whose numbers are loaded. It covers the whole picture.
vtkSmartPointer<vtkChartXY> make_chart(const PlotSpec& spec);

}  // namespace softgrain
