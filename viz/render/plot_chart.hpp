#pragma once
// A plot spec as a VTK chart.
#include <vtkChartXY.h>
#include <vtkSmartPointer.h>

#include "viz/plot_spec.hpp"
#include "viz/render/page.hpp"

namespace softgrain {

/// The chart of a spec whose numbers are loaded, with room for the titles around it.
vtkSmartPointer<vtkChartXY> make_chart(const PlotSpec& spec);

/// Title and axis labels: VTK's charts draw theirs with stray pixels.
Page make_titles(const PlotSpec& spec);

}  // namespace softgrain
