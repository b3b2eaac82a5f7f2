#pragma once
// Pairs of ellipses in and out of a batch.
#include <array>
#include <bit>
#include <cstdint>

#include "sdem/geometry/chord.hpp"
#include "sdem/geometry/chord_batch.hpp"

namespace softgrain::sdem::test {

inline void set_lane(ChordBatch& batch, int k, const Ellipse& a, const Ellipse& b, const WarmStart& warm) {
    batch.dx[k] = b.center.x() - a.center.x(), batch.dy[k] = b.center.y() - a.center.y();
    batch.a_xx[k] = a.axes(0, 0), batch.a_xy[k] = a.axes(0, 1);
    batch.a_yx[k] = a.axes(1, 0), batch.a_yy[k] = a.axes(1, 1);
    batch.b_xx[k] = b.axes(0, 0), batch.b_xy[k] = b.axes(0, 1);
    batch.b_yx[k] = b.axes(1, 0), batch.b_yy[k] = b.axes(1, 1);
    batch.end_ax[k] = warm.a.x(), batch.end_ay[k] = warm.a.y();
    batch.end_bx[k] = warm.b.x(), batch.end_by[k] = warm.b.y();
}

inline WarmStart ends_of(const ChordBatch& batch, int k) {
    return {{batch.end_ax[k], batch.end_ay[k]}, {batch.end_bx[k], batch.end_by[k]}};
}

/// Everything a lane gives, as bits; `sound` last.
using LaneBits = std::array<std::uint64_t, 14>;
inline LaneBits bits_of(const ChordBatch& b, int k) {
    LaneBits bits{};
    const std::array<double, 14> values{b.chord_x[k], b.chord_y[k], b.mid_x[k],   b.mid_y[k], b.cap_a[k],
                                        b.cap_b[k],   b.cover_a[k], b.cover_b[k], b.depth[k], b.end_ax[k],
                                        b.end_ay[k],  b.end_bx[k],  b.end_by[k],  b.sound[k]};
    for (std::size_t n = 0; n < bits.size(); ++n) bits[n] = std::bit_cast<std::uint64_t>(values[n]);
    return bits;
}

}  // namespace softgrain::sdem::test
