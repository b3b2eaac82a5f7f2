#include "sdem/geometry/chord_batch.hpp"

#include <cmath>

#include "common/simd.hpp"
#include "sdem/geometry/cap.hpp"

namespace softgrain::sdem {
namespace {

using Lanes = ChordBatch::Lanes;

/// About a guess u of one end of the chord, with v = u turned by +90 degrees, b's unit circle is
/// ((1 - t^2) u + 2 t v) / (1 + t^2), and (1 + t^2)^2 g is the quartic c0 + c1 t + ... + c4 t^4.
struct Quartic {
    alignas(64) Lanes ux, uy, c0, c1, c2, c3, c4;
    alignas(64) Lanes back;    // -t after the first step towards the root
    alignas(64) Lanes excess;  // | |guess|^2 - 1 |
};
/// One end, and quartic and slope one step before.
struct End {
    alignas(64) Lanes x, y, value, slope;
};
/// One cap: q = tan(psi/2), 4 sin^2(psi/2), and det A.
struct Cap {
    alignas(64) Lanes q, y4, det;
};
/// What one loop leaves to the next: short loops keep more lanes in flight than a long one.
struct Work {
    alignas(64) Lanes dx, dy, xx, xy, yx, yy;  // d and B of chord.hpp
    alignas(64) Lanes one_minimum;             // > 0 if g has one minimum
    Quartic quartic_a, quartic_b;
    End end_a, end_b;
    Cap cap_a, cap_b;
};

struct Vector {
    double x, y;
};
SOFTGRAIN_INLINE double dot(Vector a, Vector b) {
    return a.x * b.x + a.y * b.y;
}
SOFTGRAIN_INLINE double cross(Vector a, Vector b) {
    return a.x * b.y - a.y * b.x;
}
/// Sums, since multiplications are what the loops wait for.
SOFTGRAIN_INLINE double twice(double a) {
    return a + a;
}

SOFTGRAIN_INLINE void find_level(const ChordBatch& in, Work& w, int k) {
    const double det = in.a_xx[k] * in.a_yy[k] - in.a_xy[k] * in.a_yx[k], inverse = 1.0 / det;
    const double pxx = in.a_yy[k] * inverse, pxy = in.a_xy[k] * inverse;
    const double pyx = in.a_yx[k] * inverse, pyy = in.a_xx[k] * inverse;
    const Vector d{pxx * in.dx[k] - pxy * in.dy[k], pyy * in.dy[k] - pyx * in.dx[k]};
    const double xx = pxx * in.b_xx[k] - pxy * in.b_yx[k], xy = pxx * in.b_xy[k] - pxy * in.b_yy[k];
    const double yx = pyy * in.b_yx[k] - pyx * in.b_xx[k], yy = pyy * in.b_yy[k] - pyx * in.b_xy[k];
    const double bx = xx * d.x + yx * d.y, by = xy * d.x + yy * d.y;
    const double difference = (xx * xx + yx * yx) - (xy * xy + yy * yy), mixed = twice(xx * xy + yx * yy);
    w.one_minimum[k] = (bx * bx + by * by) - (difference * difference + mixed * mixed);
    w.cap_a.det[k] = det;
    w.cap_b.det[k] = in.b_xx[k] * in.b_yy[k] - in.b_xy[k] * in.b_yx[k];
    w.dx[k] = d.x, w.dy[k] = d.y;
    w.xx[k] = xx, w.xy[k] = xy, w.yx[k] = yx, w.yy[k] = yy;
}

/// Koenig's step of order 4: the ratio of two consecutive Taylor coefficients of 1/quartic at t = 0.
SOFTGRAIN_INLINE void first_step(const Work& w, const Lanes& guess_x, const Lanes& guess_y, Quartic& q,
                                 int k) {
    // Length 1 but for rounding to float: the error left is its cube.
    const double excess = (guess_x[k] * guess_x[k] + guess_y[k] * guess_y[k]) - 1.0;
    const double scale = 1.0 - excess * (0.5 - 0.375 * excess);
    const Vector u{scale * guess_x[k], scale * guess_y[k]}, d{w.dx[k], w.dy[k]};
    const Vector p{w.xx[k] * u.x + w.xy[k] * u.y, w.yx[k] * u.x + w.yy[k] * u.y};  // B u
    const Vector v{w.xy[k] * u.x - w.xx[k] * u.y, w.yy[k] * u.x - w.yx[k] * u.y};  // B v
    const Vector near{d.x + p.x, d.y + p.y}, far{d.x - p.x, d.y - p.y}, v2{twice(v.x), twice(v.y)};
    const double c0 = dot(near, near) - 1.0, c1 = twice(dot(near, v2));
    const double c2 = dot(v2, v2) + twice(dot(near, far) - 1.0);
    const double c3 = twice(dot(v2, far)), c4 = dot(far, far) - 1.0;
    const double c02 = c0 * c2, d2 = c1 * c1 - c02, d3 = c1 * (d2 - c02) + (c0 * c0) * c3;
    q.ux[k] = u.x, q.uy[k] = u.y;
    q.c0[k] = c0, q.c1[k] = c1, q.c2[k] = c2, q.c3[k] = c3, q.c4[k] = c4;
    q.back[k] = c0 * d2 / d3;
    q.excess[k] = std::abs(excess);
}

/// Halley's step from there, and the end itself.
SOFTGRAIN_INLINE void second_step(const Quartic& q, End& end, int k) {
    const double s = q.back[k], c0 = q.c0[k], c1 = q.c1[k], c2 = q.c2[k], c3 = q.c3[k], c4 = q.c4[k];
    const double a4 = c4 * s, a3 = c3 - a4, b3 = (twice(a3) + a3) - a4;  // c3 + c4 t; 3 c3 + 4 c4 t
    const double value = c0 - s * (c1 - s * (c2 - s * a3));
    const double slope = c1 - s * (twice(c2) - s * b3);
    const double half_curvature = c2 - s * (b3 - twice(a4));
    const double t = -s - value * slope / (slope * slope - value * half_curvature);
    const double square = t * t, norm = 1.0 / (1.0 + square);
    const double cosine = (1.0 - square) * norm, sine = twice(t) * norm;
    end.x[k] = cosine * q.ux[k] - sine * q.uy[k];
    end.y[k] = cosine * q.uy[k] + sine * q.ux[k];
    end.value[k] = std::abs(value), end.slope[k] = slope;
}

/// Chord, depths, and whether to trust them.
SOFTGRAIN_INLINE void finish_chord(ChordBatch& out, Work& w, int k) {
    const Vector a{w.end_a.x[k], w.end_a.y[k]}, b{w.end_b.x[k], w.end_b.y[k]};
    // The chord and twice its mid-point in b's unit frame, in a's, and in space.
    const Vector t{b.x - a.x, b.y - a.y}, m{a.x + b.x, a.y + b.y};
    const Vector s{w.xx[k] * t.x + w.xy[k] * t.y, w.yx[k] * t.x + w.yy[k] * t.y};
    const Vector p{twice(w.dx[k]) + (w.xx[k] * m.x + w.xy[k] * m.y),
                   twice(w.dy[k]) + (w.yx[k] * m.x + w.yy[k] * m.y)};
    const Vector c{out.b_xx[k] * t.x + out.b_xy[k] * t.y, out.b_yx[k] * t.x + out.b_yy[k] * t.y};
    out.chord_x[k] = -c.y, out.chord_y[k] = c.x;
    out.mid_x[k] = out.dx[k] + 0.5 * (out.b_xx[k] * m.x + out.b_xy[k] * m.y);
    out.mid_y[k] = out.dy[k] + 0.5 * (out.b_yx[k] * m.x + out.b_yy[k] * m.y);

    // q = tan(psi/2) = sin(psi) / (1 + cos(psi)).
    const double square_a = dot(s, s), square_b = dot(t, t);  // 4 sin^2(psi)
    const double twice_sine_a = std::sqrt(square_a), twice_sine_b = std::sqrt(square_b);
    const double product_a = cross(s, p), product_b = cross(m, t);  // 4 sin(psi) cos(psi)
    const double q_a = square_a / (twice(twice_sine_a) + product_a);
    const double q_b = square_b / (twice(twice_sine_b) + product_b);
    // Depth of a cap = |A^T n| sin(psi) q, where |A^T n| = det A 2 sin(psi) / L.
    const double depths = w.cap_a.det[k] * (square_a * q_a) + w.cap_b.det[k] * (square_b * q_b);
    out.depth[k] = 0.5 * depths / std::sqrt(dot(c, c));
    w.cap_a.q[k] = q_a, w.cap_b.q[k] = q_b;
    const double y4_a = twice_sine_a * q_a, y4_b = twice_sine_b * q_b;
    w.cap_a.y4[k] = y4_a, w.cap_b.y4[k] = y4_b;
    out.cover_a[k] = 0.25 * product_a, out.cover_b[k] = 0.25 * product_b;

    // As in chord.hpp: the last step next to the opening, and the smallest opening.
    constexpr double settled = 5e-6, smallest = 1e-3, rounded = 1e-6;
    const double band = 0.5 * settled * twice_sine_b;
    const bool found =
        (w.end_a.value[k] <= band * -w.end_a.slope[k]) & (w.end_b.value[k] <= band * w.end_b.slope[k]);
    const bool guessed = (w.quartic_a.excess[k] < rounded) & (w.quartic_b.excess[k] < rounded);
    const bool sizes = (twice_sine_b > 2.0 * smallest) & (y4_a <= largest_y4) & (y4_b <= largest_y4);
    const bool sound = found & guessed & sizes & (w.one_minimum[k] > 0.0);
    out.sound[k] = sound ? 1.0 : 0.0;
    out.end_ax[k] = sound ? a.x : out.end_ax[k];
    out.end_ay[k] = sound ? a.y : out.end_ay[k];
    out.end_bx[k] = sound ? b.x : out.end_bx[k];
    out.end_by[k] = sound ? b.y : out.end_by[k];
}

/// Area and psi = area + sin(psi) cos(psi); `cover` holds the product.
SOFTGRAIN_INLINE void find_cap(const Cap& cap, Lanes& area, Lanes& cover, int k) {
    const double unit = cap.q[k] * cap_series(cap.y4[k]);
    area[k] = cap.det[k] * unit;
    cover[k] += unit;
}

}  // namespace

SOFTGRAIN_CLONES void solve_chords(ChordBatch& batch) {
    constexpr int width = 8;  // whole registers only
    const int lanes = (batch.count + width - 1) / width * width;
    Work w;
#pragma omp simd
    for (int k = 0; k < lanes; ++k) find_level(batch, w, k);
#pragma omp simd
    for (int k = 0; k < lanes; ++k) first_step(w, batch.end_ax, batch.end_ay, w.quartic_a, k);
#pragma omp simd
    for (int k = 0; k < lanes; ++k) first_step(w, batch.end_bx, batch.end_by, w.quartic_b, k);
#pragma omp simd
    for (int k = 0; k < lanes; ++k) second_step(w.quartic_a, w.end_a, k);
#pragma omp simd
    for (int k = 0; k < lanes; ++k) second_step(w.quartic_b, w.end_b, k);
#pragma omp simd
    for (int k = 0; k < lanes; ++k) finish_chord(batch, w, k);
#pragma omp simd
    for (int k = 0; k < lanes; ++k) find_cap(w.cap_a, batch.cap_a, batch.cover_a, k);
#pragma omp simd
    for (int k = 0; k < lanes; ++k) find_cap(w.cap_b, batch.cap_b, batch.cover_b, k);
}

}  // namespace softgrain::sdem
