#include "mpm/contact/model_search.hpp"

namespace softgrain::mpm {
namespace {

constexpr int bisections = 20;

}  // namespace

/// Derivative of the model's energy along the way: what balances the rest changes linearly, contacts do not.
double ModelSearch::slope(double share) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < moved_.size(); ++p) {
        const Vec2 way = onward_[p] - moved_[p], moved = moved_[p] + share * way;
        const Vec2 balance = force_[p] + share * (force_there_[p] - force_[p]);
        sum += way.dot(balance - model_.force(p, moved, model_.touch(p, moved)));
    }
    return sum;
}

double ModelSearch::approach(std::span<const Vec2> d, std::span<const Touch> as) {
    const bool first = moved_.empty();
    const std::size_t points = model_.points();
    onward_.resize(points);
    force_there_.resize(points);
    for (std::size_t p = 0; p < points; ++p) {
        onward_[p] = model_.difference(p, d);
        force_there_[p] = model_.force(p, onward_[p], as[p]);
    }
    double share = 1.0;
    if (first) {
        moved_ = onward_;
        force_ = force_there_;
    } else {
        if (slope(1.0) > 0.0) {
            double low = 0.0;
            for (int k = 0; k < bisections; ++k) {
                const double middle = 0.5 * (low + share);
                (slope(middle) > 0.0 ? share : low) = middle;
            }
        }
        for (std::size_t p = 0; p < points; ++p) {
            moved_[p] += share * (onward_[p] - moved_[p]);
            force_[p] += share * (force_there_[p] - force_[p]);
        }
    }
    return share;
}

std::vector<Touch> ModelSearch::touches() const {
    std::vector<Touch> touches;
    for (std::size_t p = 0; p < moved_.size(); ++p) touches.push_back(model_.touch(p, moved_[p]));
    return touches;
}

}  // namespace softgrain::mpm
