#pragma once
// Work against error: what the cheapest settings of an engine cost at a given penetration.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace softgrain::bpm {

struct WorkPoint {
    double penetration;  ///< [mean disc diameters]
    double cost;         ///< CPU time per unit of physical time [s]
};

/// The points that no other one beats in both, by falling penetration and rising cost.
inline std::vector<WorkPoint> pareto_front(std::vector<WorkPoint> points) {
    std::sort(points.begin(), points.end(), [](const WorkPoint& a, const WorkPoint& b) {
        return a.cost != b.cost ? a.cost < b.cost : a.penetration < b.penetration;
    });
    std::vector<WorkPoint> front;
    for (const WorkPoint& point : points)
        if (front.empty() || point.penetration < front.back().penetration) front.push_back(point);
    return front;
}

/// Interpolated between the logarithms of neighbours; the cheapest point's cost if that is accurate enough;
/// nothing if no point is.
inline std::optional<double> cost_at(const std::vector<WorkPoint>& front, double penetration) {
    if (front.empty() || front.back().penetration > penetration) return std::nullopt;
    if (front.front().penetration <= penetration) return front.front().cost;
    std::size_t k = 1;
    while (front[k].penetration > penetration) ++k;
    const WorkPoint &coarse = front[k - 1], &fine = front[k];
    const double share =
        std::log(coarse.penetration / penetration) / std::log(coarse.penetration / fine.penetration);
    return coarse.cost * std::pow(fine.cost / coarse.cost, share);
}

}  // namespace softgrain::bpm
