#pragma once
#include <vector>

namespace softgrain {

/// Values over bins of equal width that begin at 0.
struct Histogram {
    double bin = 0.0;
    std::vector<double> value;

    /// Middle of a bin.
    double middle(std::size_t k) const { return (static_cast<double>(k) + 0.5) * bin; }
};

}  // namespace softgrain
