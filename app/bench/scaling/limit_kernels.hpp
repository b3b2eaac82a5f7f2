#pragma once
// Loops whose speed is a limit of the machine. Each returns a number that depends on all it did.
#include <cstddef>

namespace softgrain::bench {

/// Independent vectors in a chain, so that no addition waits for the one before: what 16 registers hold.
inline constexpr std::size_t chains = 14;

/// x = x a + b in `chains` vectors of 4 or 8 doubles, `rounds` times: two operations each.
double multiply_and_add_4(long rounds);
double multiply_and_add_8(long rounds);
/// The same, fused. Only on processors that can.
double fused_multiply_add_4(long rounds);
double fused_multiply_add_8(long rounds);

/// a = b + s c in n doubles: 24 bytes each, without what the cache fetches to write over it.
double triad(double* a, const double* b, const double* c, double s, std::size_t n);

}  // namespace softgrain::bench
