#include "app/bench/stability/largest_stable.hpp"

#include <cmath>

namespace softgrain::bench {

double largest_stable(const std::function<bool(double factor)>& is_stable, const FactorSearch& search) {
    double stable = 1.0, unstable = 1.0;
    if (is_stable(1.0)) {
        do {
            stable = unstable;
            if (stable >= search.most) return search.most;
            unstable *= 2.0;
        } while (is_stable(unstable));
    } else {
        do {
            unstable = stable;
            if (unstable <= search.least) return search.least;
            stable *= 0.5;
        } while (!is_stable(stable));
    }
    while (unstable > stable * (1.0 + search.resolution)) {
        const double middle = std::sqrt(stable * unstable);
        (is_stable(middle) ? stable : unstable) = middle;
    }
    return stable;
}

}  // namespace softgrain::bench
