#include "viz/render/plot_chart.hpp"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotArea.h>
#include <vtkPlotLine.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "viz/plot_data.hpp"
#include "viz/plot_look.hpp"
#include "viz/render/scale.hpp"

namespace softgrain {
namespace {

/// Around the chart, times the font size.
constexpr double room_left = 2.0, room_right = 1.2, room_below = 2.0, room_above = 3.0;

vtkSmartPointer<vtkTable> make_table(
    std::initializer_list<std::pair<const char*, const std::vector<double>*>> columns) {
    auto table = vtkSmartPointer<vtkTable>::New();
    for (const auto& [name, values] : columns) {
        vtkNew<vtkDoubleArray> column;
        column->SetName(name);
        for (const double v : *values) column->InsertNextValue(v);
        if (values->size() == 1) column->InsertNextValue(values->front());  // VTK draws no single point
        table->AddColumn(column);
    }
    return table;
}

int pen_type(LineStyle style) {
    switch (style) {
        case LineStyle::none:
            return vtkPen::NO_PEN;
        case LineStyle::solid:
            return vtkPen::SOLID_LINE;
        case LineStyle::dashed:
            return vtkPen::DASH_LINE;
        case LineStyle::dotted:
            return vtkPen::DOT_LINE;
    }
    return vtkPen::SOLID_LINE;
}

int marker_type(MarkerStyle style) {
    switch (style) {
        case MarkerStyle::none:
            return vtkPlotPoints::NONE;
        case MarkerStyle::circle:
            return vtkPlotPoints::CIRCLE;
        case MarkerStyle::square:
            return vtkPlotPoints::SQUARE;
        case MarkerStyle::diamond:
            return vtkPlotPoints::DIAMOND;
        case MarkerStyle::cross:
            return vtkPlotPoints::CROSS;
        case MarkerStyle::plus:
            return vtkPlotPoints::PLUS;
    }
    return vtkPlotPoints::NONE;
}

void add_band(vtkChartXY& chart, const PlotSeries& series, Colour colour) {
    if (series.lower.empty()) return;
    auto* band = vtkPlotArea::SafeDownCast(chart.AddPlot(vtkChart::AREA));
    band->SetInputData(make_table({{"x", &series.x}, {"lower", &series.lower}, {"upper", &series.upper}}));
    band->SetInputArray(0, "x");
    band->SetInputArray(1, "lower");
    band->SetInputArray(2, "upper");
    band->GetBrush()->SetColor(colour[0], colour[1], colour[2], look::band_opacity);
    band->GetPen()->SetLineType(vtkPen::NO_PEN);
    band->SetLegendVisibility(false);
}

void add_line(vtkChartXY& chart, const PlotSeries& series, Colour colour, double font) {
    auto* plot = vtkPlotLine::SafeDownCast(chart.AddPlot(vtkChart::LINE));
    plot->SetInputData(make_table({{"x", &series.x}, {"y", &series.y}}), 0, 1);
    plot->SetLabel(series.label);
    plot->SetLegendVisibility(!series.label.empty());
    plot->SetColor(colour[0], colour[1], colour[2], colour[3]);
    plot->SetWidth(static_cast<float>(look::line_width * font * series.width));
    plot->GetPen()->SetLineType(pen_type(series.line));
    plot->SetMarkerStyle(marker_type(series.marker));
    plot->SetMarkerSize(static_cast<float>(look::marker_size * font));
}

/// Few round ticks; the chart's own are many and of uneven length. Logarithmic axes keep the chart's.
void set_ticks(vtkAxis& axis, const PlotRange& range) {
    const auto ticks = round_ticks(range.min, range.max);
    vtkNew<vtkDoubleArray> positions;
    vtkNew<vtkStringArray> labels;
    for (const double tick : ticks) {
        positions->InsertNextValue(tick);
        labels->InsertNextValue(tick_text(tick, ticks.size() > 1 ? ticks[1] - ticks[0] : tick));
    }
    axis.SetCustomTickPositions(positions, labels);
}

void set_axis(vtkAxis& axis, const PlotAxis& spec, const PlotRange& range, double font) {
    axis.SetTitle("");
    axis.SetLogScale(spec.logarithmic);
    axis.SetBehavior(vtkAxis::FIXED);
    axis.SetLabelOffset(static_cast<float>(0.45 * font));
    axis.SetUnscaledRange(range.min, range.max);
    set_font(*axis.GetLabelProperties(), look::small_text * font, false);
    axis.GetGridPen()->SetColor(look::grid_grey, look::grid_grey, look::grid_grey);
    axis.GetGridPen()->SetWidth(1.0F);
    if (!spec.logarithmic) set_ticks(axis, range);
    axis.GetPen()->SetWidth(static_cast<float>(look::axis_width * font));
}

void place_legend(vtkChartXY& chart, const PlotSpec& spec, double font) {
    const auto labelled = std::count_if(spec.series.begin(), spec.series.end(),
                                        [](const PlotSeries& s) { return !s.label.empty(); });
    chart.SetShowLegend(spec.legend != "none" && labelled > 0);
    vtkChartLegend& legend = *chart.GetLegend();
    set_font(*legend.GetLabelProperties(), look::small_text * font, false);
    legend.SetLabelSize(static_cast<int>(std::lround(look::small_text * font)));
    legend.SetSymbolWidth(static_cast<int>(std::lround(look::legend_symbol * font)));
    legend.SetPadding(static_cast<int>(std::lround(look::legend_padding * font)));
    legend.GetPen()->SetColor(look::legend_edge_grey, look::legend_edge_grey, look::legend_edge_grey);
    legend.GetBrush()->SetColor(255, 255, 255, look::legend_opacity);
    legend.SetInline(true);
    double widest = 0.0;
    for (const PlotSeries& series : spec.series)
        widest = std::max(widest, text_width(series.label, look::small_text * font, false));
    const double box_width = (widest + 4.0 * font) / (0.85 * spec.width);
    const double box_height = 1.5 * font * static_cast<double>(labelled + 1) / (0.8 * spec.height);
    const std::string corner =
        spec.legend == "auto" ? emptiest_corner(spec, box_width, box_height) : spec.legend;
    legend.SetHorizontalAlignment(corner.ends_with("left") ? vtkChartLegend::LEFT : vtkChartLegend::RIGHT);
    legend.SetVerticalAlignment(corner.starts_with("bottom") ? vtkChartLegend::BOTTOM : vtkChartLegend::TOP);
    if (corner == "right") legend.SetInline(false);
}

}  // namespace

vtkSmartPointer<vtkChartXY> make_chart(const PlotSpec& spec) {
    const double font = look::font_size(spec);
    auto chart = vtkSmartPointer<vtkChartXY>::New();
    const float bottom = static_cast<float>(room_below * font);
    const float left = static_cast<float>(room_left * font);
    const float right = static_cast<float>(room_right * font);
    const float top = static_cast<float>((spec.title.empty() ? room_right : room_above) * font);
    chart->SetAutoSize(false);
    chart->SetSize(vtkRectf(left, bottom, static_cast<float>(spec.width) - left - right,
                            static_cast<float>(spec.height) - bottom - top));
    set_axis(*chart->GetAxis(vtkAxis::BOTTOM), spec.x, x_range(spec), font);
    set_axis(*chart->GetAxis(vtkAxis::LEFT), spec.y, y_range(spec), font);
    std::size_t number = 0;
    for (const PlotSeries& series : spec.series) {
        const Colour colour = look::colour_of(series, number++);
        add_band(*chart, series, colour);
        add_line(*chart, series, colour, font);
    }
    place_legend(*chart, spec, font);
    return chart;
}

Page make_titles(const PlotSpec& spec) {
    const double font = look::font_size(spec);
    Page page(spec.width, spec.height);
    page.text({spec.width / 2.0, spec.height - 0.5 * room_above * font}, spec.title,
              {look::title_text * font, Align::centre, Align::centre, false, true});
    page.text({spec.width / 2.0, 0.6 * room_below * font}, spec.x.label,
              {font, Align::centre, Align::centre});
    page.text({0.6 * room_left * font, spec.height / 2.0}, spec.y.label,
              {font, Align::centre, Align::centre, true});
    return page;
}

}  // namespace softgrain
