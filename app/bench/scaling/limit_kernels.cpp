#include "app/bench/scaling/limit_kernels.hpp"

#include "common/simd.hpp"

namespace softgrain::bench {
namespace {

typedef double Four __attribute__((vector_size(32)));
typedef double Eight __attribute__((vector_size(64)));

template <class V, bool Fused>
SOFTGRAIN_INLINE double chain(long rounds) {
    constexpr std::size_t lanes = sizeof(V) / sizeof(double);
    constexpr double a = 0.999, b = 0.001;  // goes to 1
    V x[chains];
    for (std::size_t k = 0; k < chains; ++k) x[k] = V{} + static_cast<double>(k);
    for (long round = 0; round < rounds; ++round)
#pragma GCC unroll 14
        for (std::size_t k = 0; k < chains; ++k) {
            if constexpr (Fused) {
                for (std::size_t lane = 0; lane < lanes; ++lane) x[k][lane] = __builtin_fma(x[k][lane], a, b);
            } else {
                x[k] = x[k] * a + b;
            }
        }
    double sum = 0.0;
    for (std::size_t k = 0; k < chains; ++k)
        for (std::size_t lane = 0; lane < lanes; ++lane) sum += x[k][lane];
    return sum;
}

}  // namespace

SOFTGRAIN_CLONES double multiply_and_add_4(long rounds) {
    return chain<Four, false>(rounds);
}
SOFTGRAIN_CLONES double multiply_and_add_8(long rounds) {
    return chain<Eight, false>(rounds);
}
SOFTGRAIN_CLONES double fused_multiply_add_4(long rounds) {
    return chain<Four, true>(rounds);
}
SOFTGRAIN_CLONES double fused_multiply_add_8(long rounds) {
    return chain<Eight, true>(rounds);
}

SOFTGRAIN_CLONES double triad(double* a, const double* b, const double* c, double s, std::size_t n) {
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + s * c[i];
    return a[n / 2];
}

}  // namespace softgrain::bench
