#include "common/contact_dynamics/contact_blocks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <span>

namespace softgrain {
namespace {

class Cutter {
  public:
    Cutter(const Discs& discs, int most_discs, ContactBlocks& blocks)
        : discs_(discs), most_(static_cast<std::size_t>(most_discs)), blocks_(blocks) {}

    /// Makes blocks of some discs of one group.
    void cut(std::span<int> part) {
        if (part.size() <= most_) {
            for (int d : part) blocks_.of_disc[static_cast<std::size_t>(d)] = blocks_.size();
            blocks_.group_of_block.push_back(discs_.group[static_cast<std::size_t>(part.front())]);
            return;
        }
        Eigen::AlignedBox2d extent;
        for (int d : part) extent.extend(place(d));
        const int axis = extent.sizes().x() < extent.sizes().y() ? 1 : 0;
        const std::size_t half = part.size() / 2;
        std::sort(part.begin(), part.end(), [&](int a, int b) {
            return place(a)[axis] != place(b)[axis] ? place(a)[axis] < place(b)[axis] : a < b;
        });
        cut(part.first(half));
        cut(part.subspan(half));
    }

  private:
    const Vec2& place(int disc) const { return discs_.x[static_cast<std::size_t>(disc)]; }

    const Discs& discs_;
    std::size_t most_;
    ContactBlocks& blocks_;
};

}  // namespace

ContactBlocks::ContactBlocks(const Discs& discs, int most_discs) : of_disc(discs.x.size()) {
    std::vector<int> order(discs.x.size());
    std::iota(order.begin(), order.end(), 0);
    const auto group = [&](int d) { return discs.group[static_cast<std::size_t>(d)]; };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return group(a) < group(b); });
    Cutter cutter(discs, most_discs, *this);
    for (auto first = order.begin(); first != order.end();) {
        const auto last = std::find_if(first, order.end(), [&](int d) { return group(d) != group(*first); });
        cutter.cut({first, last});
        first = last;
    }
}

}  // namespace softgrain
