#pragma once
// Sums by threads with the same bits for any number of them.
#include <array>
#include <cstddef>

namespace softgrain {

/// term(0) + ... + term(n - 1), summed block by block; the blocks depend on n only.
template <class Term>
double block_sum(std::size_t n, bool threads, Term term) {
    constexpr std::size_t blocks = 32;
    std::array<double, blocks> part{};
#pragma omp parallel for schedule(static) if (threads)
    for (std::size_t b = 0; b < blocks; ++b) {
        double sum = 0.0;
        for (std::size_t k = b * n / blocks; k < (b + 1) * n / blocks; ++k) sum += term(k);
        part[b] = sum;
    }
    double sum = 0.0;
    for (const double p : part) sum += p;
    return sum;
}

}  // namespace softgrain
