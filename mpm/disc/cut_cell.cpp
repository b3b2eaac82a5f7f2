#include "mpm/disc/cut_cell.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace softgrain::mpm {
namespace {

constexpr double gauss = 0.57735026918962576451;  // 1/sqrt(3)
constexpr double same_direction = 1e-9;
constexpr double smallest_share = 1e-12;  // of the rectangle, below which a piece is nothing

/// Heights between which the line at x lies in rectangle and disc.
std::array<double, 2> heights(double x, double low, double high) {
    const double s = std::sqrt(std::max(0.0, 1.0 - x * x));
    return {std::clamp(low, -s, s), std::clamp(high, -s, s)};
}

/// Area of the piece between two x without a break in between.
double exact_area(double x0, double x1, double low, double high) {
    const auto under_circle = [](double x) {
        return 0.5 * (x * std::sqrt(std::max(0.0, 1.0 - x * x)) + std::asin(x));
    };
    const double arc = under_circle(x1) - under_circle(x0), width = x1 - x0;
    const double middle = 0.5 * (x0 + x1), s = std::sqrt(std::max(0.0, 1.0 - middle * middle));
    const double top = high < s ? high * width : arc;
    const double bottom = low > -s ? low * width : -arc;
    return std::max(0.0, top - bottom);
}

/// Pieces by columns; the circle is a function of x.
void add_columns(const Vec2& low, const Vec2& high, bool swapped, std::vector<QuadraturePoint>& out) {
    std::vector<double> breaks{low.x(), high.x()};
    for (const double y : {low.y(), high.y()})
        if (std::abs(y) < 1.0)
            for (const double x : {-std::sqrt(1.0 - y * y), std::sqrt(1.0 - y * y)})
                if (x > low.x() && x < high.x()) breaks.push_back(x);
    for (const double x : {-1.0, 1.0})
        if (x > low.x() && x < high.x()) breaks.push_back(x);
    std::sort(breaks.begin(), breaks.end());
    const double whole = (high - low).prod();
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
        const double x0 = std::max(-1.0, breaks[k]), x1 = std::min(1.0, breaks[k + 1]);
        if (x1 <= x0) continue;
        const double area = exact_area(x0, x1, low.y(), high.y());
        if (area <= smallest_share * whole) continue;
        // By the angle whose sine is x the integrand has no root.
        const double a0 = std::asin(x0), a1 = std::asin(x1);
        const std::size_t first = out.size();
        double sum = 0.0;
        for (const double s : {-gauss, gauss}) {
            const double angle = 0.5 * (a0 + a1 + s * (a1 - a0)), x = std::sin(angle);
            const auto [y0, y1] = heights(x, low.y(), high.y());
            const double column = std::max(0.0, y1 - y0) * std::cos(angle);
            for (const double t : {-gauss, gauss}) {
                const Vec2 p{x, 0.5 * (y0 + y1 + t * (y1 - y0))};
                out.push_back({swapped ? Vec2{p.y(), p.x()} : p, column});
                sum += column;
            }
        }
        for (std::size_t q = first; q < out.size(); ++q) out[q].weight *= area / sum;
    }
}

}  // namespace

std::vector<QuadraturePoint> quadrature_in_disc(const Vec2& low, const Vec2& high) {
    const Vec2 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    std::vector<QuadraturePoint> points;
    if ((middle.cwiseAbs() + half).norm() <= 1.0) {
        for (const double s : {-gauss, gauss})
            for (const double t : {-gauss, gauss})
                points.push_back({middle + half.cwiseProduct(Vec2{s, t}), half.prod()});
        return points;
    }
    // Columns along the direction in which the circle is less steep; on a diagonal the mean of both, so that
    // the disc has the symmetry of its grid.
    const double x = std::abs(middle.x()), y = std::abs(middle.y());
    const bool diagonal = std::abs(x - y) < same_direction;
    if (y >= x || diagonal) add_columns(low, high, false, points);
    if (x > y || diagonal) add_columns({low.y(), low.x()}, {high.y(), high.x()}, true, points);
    if (diagonal)
        for (QuadraturePoint& p : points) p.weight *= 0.5;
    return points;
}

}  // namespace softgrain::mpm
