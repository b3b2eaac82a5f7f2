#include "common/space_order.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace softgrain {
namespace {

/// The bits of v with a zero between each two.
std::uint64_t spread(std::uint64_t v) {
    v = (v | v << 16) & 0x0000ffff0000ffffULL;
    v = (v | v << 8) & 0x00ff00ff00ff00ffULL;
    v = (v | v << 4) & 0x0f0f0f0f0f0f0f0fULL;
    v = (v | v << 2) & 0x3333333333333333ULL;
    return (v | v << 1) & 0x5555555555555555ULL;
}

}  // namespace

std::vector<int> space_order(std::span<const Vec2> x, double cell) {
    std::vector<int> order(x.size());
    std::iota(order.begin(), order.end(), 0);
    if (x.empty()) return order;
    Vec2 low = x.front();
    for (const Vec2& p : x) low = low.cwiseMin(p);
    std::vector<std::uint64_t> key;
    for (const Vec2& p : x) {
        const Vec2 cells = ((p - low) / cell).cwiseMin(4294967295.0);
        key.push_back(spread(static_cast<std::uint32_t>(cells.x())) |
                      spread(static_cast<std::uint32_t>(cells.y())) << 1);
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return key[static_cast<std::size_t>(a)] < key[static_cast<std::size_t>(b)];
    });
    return order;
}

}  // namespace softgrain
