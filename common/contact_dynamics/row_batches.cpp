#include "common/contact_dynamics/row_batches.hpp"

#include <cstring>

#include "common/simd.hpp"

namespace softgrain::contact_sweep {
namespace {

// N rows side by side: x and y of each take two lanes; a row's scalars are in both of them.
template <int N>
struct Lanes;

template <>
struct Lanes<1> {
    using Pairs = double __attribute__((vector_size(16)));
    SOFTGRAIN_INLINE static Pairs swap(Pairs a) { return __builtin_shufflevector(a, a, 1, 0); }
    SOFTGRAIN_INLINE static Pairs twice(const double* p) { return Pairs{p[0], p[0]}; }
    SOFTGRAIN_INLINE static void put_firsts(double* p, Pairs a) { p[0] = a[0]; }
    SOFTGRAIN_INLINE static Pairs gather(const double* v, const int* index) {
        Pairs a;
        std::memcpy(&a, v + 2 * static_cast<long>(index[0]), sizeof a);
        return a;
    }
    SOFTGRAIN_INLINE static void scatter(double* v, const int* index, Pairs a) {
        std::memcpy(v + 2 * static_cast<long>(index[0]), &a, sizeof a);
    }
};
using OnePair = Lanes<1>::Pairs;

template <>
struct Lanes<2> {
    using Pairs = double __attribute__((vector_size(32)));
    SOFTGRAIN_INLINE static Pairs swap(Pairs a) { return __builtin_shufflevector(a, a, 1, 0, 3, 2); }
    SOFTGRAIN_INLINE static Pairs twice(const double* p) {
        OnePair a;
        std::memcpy(&a, p, sizeof a);
        return __builtin_shufflevector(a, a, 0, 0, 1, 1);
    }
    SOFTGRAIN_INLINE static void put_firsts(double* p, Pairs a) {
        const OnePair b = __builtin_shufflevector(a, a, 0, 2);
        std::memcpy(p, &b, sizeof b);
    }
    SOFTGRAIN_INLINE static Pairs gather(const double* v, const int* index) {
        return __builtin_shufflevector(Lanes<1>::gather(v, index), Lanes<1>::gather(v, index + 1), 0, 1, 2,
                                       3);
    }
    SOFTGRAIN_INLINE static void scatter(double* v, const int* index, Pairs a) {
        Lanes<1>::scatter(v, index, __builtin_shufflevector(a, a, 0, 1));
        Lanes<1>::scatter(v, index + 1, __builtin_shufflevector(a, a, 2, 3));
    }
};
using TwoPairs = Lanes<2>::Pairs;

template <>
struct Lanes<4> {
    using Pairs = double __attribute__((vector_size(64)));
    SOFTGRAIN_INLINE static Pairs swap(Pairs a) {
        return __builtin_shufflevector(a, a, 1, 0, 3, 2, 5, 4, 7, 6);
    }
    SOFTGRAIN_INLINE static Pairs twice(const double* p) {
        TwoPairs a;
        std::memcpy(&a, p, sizeof a);
        return __builtin_shufflevector(a, a, 0, 0, 1, 1, 2, 2, 3, 3);
    }
    SOFTGRAIN_INLINE static void put_firsts(double* p, Pairs a) {
        const TwoPairs b = __builtin_shufflevector(a, a, 0, 2, 4, 6);
        std::memcpy(p, &b, sizeof b);
    }
    SOFTGRAIN_INLINE static Pairs gather(const double* v, const int* index) {
        return __builtin_shufflevector(Lanes<2>::gather(v, index), Lanes<2>::gather(v, index + 2), 0, 1, 2, 3,
                                       4, 5, 6, 7);
    }
    SOFTGRAIN_INLINE static void scatter(double* v, const int* index, Pairs a) {
        Lanes<2>::scatter(v, index, __builtin_shufflevector(a, a, 0, 1, 2, 3));
        Lanes<2>::scatter(v, index + 2, __builtin_shufflevector(a, a, 4, 5, 6, 7));
    }
};

template <int N>
SOFTGRAIN_INLINE double relax(const FrictionlessRows& rows, double omega, int first, int last) {
    using L = Lanes<N>;
    using Pairs = typename L::Pairs;
    const Pairs zero = {};
    Pairs largest = zero;
    for (int k = first; k < last; k += N) {
        Pairs n;
        std::memcpy(&n, rows.direction + 2 * static_cast<long>(k), sizeof n);
        const Pairs vi = L::gather(rows.v, rows.i + k);
        const Pairs vj = L::gather(rows.v, rows.j + k);
        const Pairs along = n * (vj - vi);
        const Pairs old = L::twice(rows.normal + k);
        const Pairs wanted = old - omega * ((along + L::swap(along)) + L::twice(rows.gap_speed + k));
        const Pairs now = wanted > 0.0 ? wanted : zero;
        const Pairs change = now - old;
        const Pairs on_i = L::twice(rows.share + k) * change;
        L::put_firsts(rows.normal + k, now);
        L::scatter(rows.v, rows.i + k, vi - on_i * n);
        L::scatter(rows.v, rows.j + k, vj + (change - on_i) * n);
        const Pairs size = change < 0.0 ? -change : change;
        largest = size > largest ? size : largest;
    }
    double result = 0.0;
    for (int lane = 0; lane < 2 * N; ++lane) result = largest[lane] > result ? largest[lane] : result;
    return result;
}

using Relax = double (*)(const FrictionlessRows&, double, int, int);

double relax_by_one(const FrictionlessRows& rows, double omega, int first, int last) {
    return relax<1>(rows, omega, first, last);
}
#if SOFTGRAIN_CAN_CLONE && SOFTGRAIN_SIMD_LEVEL >= 1
__attribute__((target("arch=x86-64-v3"))) double relax_by_two(const FrictionlessRows& rows, double omega,
                                                              int first, int last) {
    return relax<2>(rows, omega, first, last);
}
#endif
#if SOFTGRAIN_CAN_CLONE && SOFTGRAIN_SIMD_LEVEL >= 2
__attribute__((target("arch=x86-64-v4"))) double relax_by_four(const FrictionlessRows& rows, double omega,
                                                               int first, int last) {
    return relax<4>(rows, omega, first, last);
}
#endif

Relax relax_by(int rows_in_vector) {
    switch (rows_in_vector) {
#if SOFTGRAIN_CAN_CLONE && SOFTGRAIN_SIMD_LEVEL >= 2
        case 4:
            return &relax_by_four;
#endif
#if SOFTGRAIN_CAN_CLONE && SOFTGRAIN_SIMD_LEVEL >= 1
        case 2:
            return &relax_by_two;
#endif
        default:
            return &relax_by_one;
    }
}

}  // namespace

int rows_in_a_vector() {
#if SOFTGRAIN_CAN_CLONE && SOFTGRAIN_SIMD_LEVEL >= 2
    if (__builtin_cpu_supports("x86-64-v4")) return 4;
#endif
#if SOFTGRAIN_CAN_CLONE && SOFTGRAIN_SIMD_LEVEL >= 1
    if (__builtin_cpu_supports("x86-64-v3")) return 2;
#endif
    return 1;
}

double relax_batches(const FrictionlessRows& rows, double omega, int first, int last) {
    static const Relax best = relax_by(rows_in_a_vector());
    return best(rows, omega, first, last);
}

double relax_batches_by(int rows_in_vector, const FrictionlessRows& rows, double omega, int first, int last) {
    return relax_by(rows_in_vector)(rows, omega, first, last);
}

}  // namespace softgrain::contact_sweep
