#pragma once
// The batched chord compiled for one level of x86-64 each: see cmake/chord_variants.cmake. For comparisons.
#include <array>

#include "sdem/geometry/chord_batch.hpp"

namespace softgrain::sdem {

struct ChordVariant {
    const char* name;
    void (*solve)(ChordBatch&);
    bool runs;  ///< this processor has the instructions
};

#ifdef SOFTGRAIN_CHORD_VARIANTS
void solve_chords_v2(ChordBatch& batch);
void solve_chords_v3(ChordBatch& batch);
void solve_chords_v4(ChordBatch& batch);

inline std::array<ChordVariant, 3> chord_variants() {
    return {{{"x86-64-v2", solve_chords_v2, __builtin_cpu_supports("sse4.2") != 0},
             {"x86-64-v3", solve_chords_v3, __builtin_cpu_supports("avx2") != 0},
             {"x86-64-v4", solve_chords_v4,
              __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0}}};
}
#else
inline std::array<ChordVariant, 0> chord_variants() {
    return {};
}
#endif

}  // namespace softgrain::sdem
