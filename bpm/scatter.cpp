#include "bpm/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/stop.hpp"

namespace softgrain::bpm {
namespace {

constexpr int misses_to_grow = 200;
constexpr double growth = 1.05;

/// Thrown discs by cells as wide as the largest disc. Places beyond the grid belong to its border.
class Cells {
  public:
    Cells(double half_width, double cell)
        : half_width_(half_width),
          cell_(cell),
          count_(static_cast<int>(std::ceil(2.0 * half_width / cell)) + 1),
          discs_(static_cast<std::size_t>(count_) * static_cast<std::size_t>(count_)) {}

    void add(int disc, const Vec2& x) { discs_[at(index(x.x()), index(x.y()))].push_back(disc); }

    template <class Test>
    bool any_near(const Vec2& x, Test test) const {
        const int column = index(x.x()), row = index(x.y());
        for (int c = std::max(0, column - 1); c <= std::min(count_ - 1, column + 1); ++c)
            for (int r = std::max(0, row - 1); r <= std::min(count_ - 1, row + 1); ++r)
                if (std::ranges::any_of(discs_[at(c, r)], test)) return true;
        return false;
    }

  private:
    int index(double u) const {
        return static_cast<int>(std::clamp((u + half_width_) / cell_, 0.0, count_ - 1.0));
    }
    std::size_t at(int column, int row) const {
        return static_cast<std::size_t>(column) * static_cast<std::size_t>(count_) +
               static_cast<std::size_t>(row);
    }

    double half_width_, cell_;
    int count_;
    std::vector<std::vector<int>> discs_;
};

}  // namespace

std::vector<Vec2> scatter_in_circle(std::span<const double> radius, double fraction, Random& random) {
    std::vector<int> order(radius.size());
    std::iota(order.begin(), order.end(), 0);
    const auto radius_of = [&](int d) { return radius[static_cast<std::size_t>(d)]; };
    std::ranges::stable_sort(order, std::greater{}, radius_of);
    double square_sum = 0.0;
    for (double r : radius) square_sum += r * r;
    double circle = std::sqrt(square_sum / fraction);
    Cells cells(circle, 2.0 * radius_of(order.front()));
    std::vector<Vec2> x(radius.size());
    int misses = 0;
    for (std::size_t thrown = 0; thrown < order.size();) {
        heed_stop();
        const int disc = order[thrown];
        const double r = radius_of(disc);
        const double distance = (circle - r) * std::sqrt(random.uniform());
        const double angle = 2.0 * std::numbers::pi * random.uniform();
        const Vec2 place{distance * std::cos(angle), distance * std::sin(angle)};
        const bool taken = cells.any_near(place, [&](int other) {
            const double reach = radius_of(other) + r;
            return (x[static_cast<std::size_t>(other)] - place).squaredNorm() <= reach * reach;
        });
        if (!taken) {
            x[static_cast<std::size_t>(disc)] = place;
            cells.add(disc, place);
            ++thrown;
            misses = 0;
        } else if (++misses > misses_to_grow) {
            circle *= growth;
            misses = 0;
        }
    }
    return x;
}

}  // namespace softgrain::bpm
