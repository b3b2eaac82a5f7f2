#include "bpm/disc_stripes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/at.hpp"

namespace softgrain::bpm {
namespace {

// Height of a stripe / mean reach of a disc: a run of eight then holds most of a disc's neighbours there.
constexpr double stripe_height = 0.6;

}  // namespace

void DiscStripes::build(std::span<const Vec2> x, std::span<const double> radius, double cut_off,
                        double skin) {
    cut_off_ = cut_off;
    skin_ = skin;
    place(x, radius);
    find_runs();
    x_built_ = x_;
    y_built_ = y_;
}

void DiscStripes::place(std::span<const Vec2> x, std::span<const double> radius) {
    const auto discs = static_cast<double>(x.size());
    double low = far_away, high = -far_away, mean_radius = 0.0;
    for (std::size_t d = 0; d < x.size(); ++d) {
        low = std::min(low, x[d].y());
        high = std::max(high, x[d].y());
        mean_radius += radius[d] / discs;
    }
    // Discs strewn far apart do not get a stripe each.
    const double height =
        std::max(stripe_height * (2.0 * cut_off_ * mean_radius + skin_), (high - low) / (2.0 * discs));
    std::vector<int> stripe_of(x.size());
    for (std::size_t d = 0; d < x.size(); ++d)
        stripe_of[d] = static_cast<int>(std::min(2.0 * discs, std::max(0.0, (x[d].y() - low) / height)));
    disc_.resize(x.size());
    std::iota(disc_.begin(), disc_.end(), 0);
    std::sort(disc_.begin(), disc_.end(), [&](int a, int b) {
        if (stripe_of[at(a)] != stripe_of[at(b)]) return stripe_of[at(a)] < stripe_of[at(b)];
        if (x[at(a)].x() != x[at(b)].x()) return x[at(a)].x() < x[at(b)].x();
        return a < b;
    });

    stripes_.clear();
    slot_.clear();
    int slot = 0;
    for (std::size_t n = 0; n < disc_.size(); ++n) {
        const auto d = at(disc_[n]);
        if (n == 0 || stripe_of[d] != stripe_of[at(disc_[n - 1])]) {
            if (n > 0) slot += run_length - 1;  // the last run of a stripe must not enter the next
            stripes_.push_back({slot, slot, x[d].y(), x[d].y(), 0.0});
        }
        Stripe& stripe = stripes_.back();
        stripe.low = std::min(stripe.low, x[d].y());
        stripe.high = std::max(stripe.high, x[d].y());
        stripe.largest_radius = std::max(stripe.largest_radius, radius[d]);
        slot_.push_back(slot);
        stripe.end = ++slot;
    }
    const std::size_t slots = (at(slot) + 2 * run_length - 2) / run_length * run_length;
    x_.assign(slots, far_away);
    y_.assign(slots, far_away);
    radius_.assign(slots, mean_radius);
    for (std::size_t n = 0; n < disc_.size(); ++n) radius_[at(slot_[n])] = radius[at(disc_[n])];
    move_to(x);
}

void DiscStripes::find_runs() {
    start_.assign(1, 0);
    run_.clear();
    for (const int slot : slot_) {
        const double x = x_[at(slot)], y = y_[at(slot)];
        for (const Stripe& stripe : stripes_) {
            const double reach = cut_off_ * (radius_[at(slot)] + stripe.largest_radius) + skin_;
            const double above = std::max({0.0, stripe.low - y, y - stripe.high});
            if (above >= reach) continue;
            const double half = std::sqrt(reach * reach - above * above);
            const auto begin = x_.begin() + stripe.begin, end = x_.begin() + stripe.end;
            const auto first = std::lower_bound(begin, end, x - half);
            const auto last = std::upper_bound(first, end, x + half);
            for (auto run = first; run < last; run += std::min<std::ptrdiff_t>(run_length, last - run))
                run_.push_back(static_cast<int>(run - x_.begin()));
        }
        start_.push_back(static_cast<int>(run_.size()));
    }
}

void DiscStripes::move_to(std::span<const Vec2> x) {
    for (std::size_t n = 0; n < disc_.size(); ++n) {
        const Vec2& place = x[at(disc_[n])];
        x_[at(slot_[n])] = place.x();
        y_[at(slot_[n])] = place.y();
    }
}

StripedDiscs DiscStripes::discs() const {
    return {static_cast<int>(disc_.size()),
            x_.size(),
            x_.data(),
            y_.data(),
            radius_.data(),
            disc_.data(),
            slot_.data(),
            start_.data(),
            run_.data()};
}

double DiscStripes::largest_square_move() const {
    return bpm::largest_square_move(discs(), x_built_.data(), y_built_.data());
}

int DiscStripes::lost_discs() const {
    if (disc_.size() == 1) return 0;
    const auto meets_another = [&](std::size_t n) {
        const auto own = at(slot_[n]);
        for (int k = start_[n]; k < start_[n + 1]; ++k)
            for (auto other = at(run_[at(k)]); other < at(run_[at(k)] + run_length); ++other) {
                const double reach = cut_off_ * (radius_[own] + radius_[other]) + skin_;
                const double dx = x_[other] - x_[own], dy = y_[other] - y_[own];
                if (other != own && dx * dx + dy * dy < reach * reach) return true;
            }
        return false;
    };
    int lost = 0;
    for (std::size_t n = 0; n < disc_.size(); ++n) lost += meets_another(n) ? 0 : 1;
    return lost;
}

}  // namespace softgrain::bpm
