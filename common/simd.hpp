#pragma once
// Functions compiled for several instruction sets, the best of which is chosen when the program starts.
//
// SOFTGRAIN_SIMD_LEVEL comes from the CMake option SOFTGRAIN_SIMD: 2 (auto) up to AVX-512, 1 (avx2) up to
// AVX2, 0 (none, or sanitizers) one version only, as on other processors and compilers.

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__)
#define SOFTGRAIN_CAN_CLONE 1
#else
#define SOFTGRAIN_CAN_CLONE 0
#endif

/// Goes before the definition of a function made of `#pragma omp simd` loops. What it calls must be
/// SOFTGRAIN_INLINE, or it is compiled for the oldest processor.
#if SOFTGRAIN_CAN_CLONE && SOFTGRAIN_SIMD_LEVEL >= 2
#define SOFTGRAIN_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#elif SOFTGRAIN_CAN_CLONE && SOFTGRAIN_SIMD_LEVEL == 1
#define SOFTGRAIN_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define SOFTGRAIN_CLONES
#endif

/// A piece of such a loop.
#if defined(__GNUC__)
#define SOFTGRAIN_INLINE __attribute__((always_inline)) inline
#else
#define SOFTGRAIN_INLINE inline
#endif
