#include "app/bench/scaling/machine_limits.hpp"

#include <algorithm>
#include <vector>

#include "app/bench/scaling/limit_kernels.hpp"
#include "app/process.hpp"
#include "common/simd.hpp"

namespace softgrain::bench {
namespace {

constexpr int tries = 7;
constexpr double long_enough = 0.01;                                      // CPU time of a try [s]
constexpr std::size_t in_cache = 1024, in_memory = std::size_t{1} << 23;  // doubles in each of three arrays

/// Most work in a second of `tries` tries; run(rounds) does rounds times `work`.
template <class Run>
double best_rate(double work, Run run) {
    long rounds = 1;
    double best = 0.0;
    volatile double result = 0.0;
    for (int done = 0; done < tries;) {
        const double begin = cpu_clock();
        result = run(rounds);
        const double seconds = cpu_clock() - begin;
        if (seconds < long_enough) {
            rounds *= 2;
            continue;
        }
        best = std::max(best, static_cast<double>(rounds) * work / seconds);
        ++done;
    }
    static_cast<void>(result);
    return best;
}

double triad_rate(std::size_t n) {
    std::vector<double> a(n), b(n, 1.0), c(n, 2.0);
    return best_rate(24.0 * static_cast<double>(n), [&](long rounds) {
        double sum = 0.0;
        for (long round = 0; round < rounds; ++round)
            sum += triad(a.data(), b.data(), c.data(), static_cast<double>(round), n);
        return sum;
    });
}

bool can_fuse() {
#if SOFTGRAIN_CAN_CLONE && SOFTGRAIN_SIMD_LEVEL >= 1  // else it is a call of a function
    return __builtin_cpu_supports("fma") != 0;
#else
    return false;
#endif
}

}  // namespace

MachineLimits machine_limits() {
    constexpr double work_4 = 2.0 * 4.0 * chains, work_8 = 2.0 * 8.0 * chains;
    MachineLimits limits;
    limits.flops = std::max(best_rate(work_4, multiply_and_add_4), best_rate(work_8, multiply_and_add_8));
    if (can_fuse())
        limits.fused_flops =
            std::max(best_rate(work_4, fused_multiply_add_4), best_rate(work_8, fused_multiply_add_8));
    limits.cache = triad_rate(in_cache);
    limits.memory = triad_rate(in_memory);
    return limits;
}

}  // namespace softgrain::bench
