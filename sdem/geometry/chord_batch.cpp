#include "sdem/geometry/chord_batch.hpp"

#include <cmath>

#include "common/simd.hpp"
#include "sdem/geometry/cap.hpp"

namespace softgrain::sdem {
namespace {

/// A number for each lane between two loops.
struct alignas(64) Work {
    using Lanes = ChordBatch::Lanes;
    alignas(64) Lanes det_a, det_b;
    alignas(64) Lanes dx, dy, xx, xy, yx, yy;              // d and B of chord.hpp
    alignas(64) Lanes one_minimum;                         // > 0 if g has one minimum
    alignas(64) Lanes ax, ay, bx, by;                      // ends of the chord
    alignas(64) Lanes value_a, slope_a, value_b, slope_b;  // g and g' one step before
    alignas(64) Lanes q_a, y_a, q_b, y_b;                  // tan(psi/2), sin^2(psi/2) of the caps
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

/// The unit circle about u, as (1 + t^2) u(t) = (1 - t^2) u + 2 t v with v = u turned by +90 degrees, on
/// which (1 + t^2)^2 g is the quartic c0 + c1 t + ... + c4 t^4.
struct Quartic {
    Vector u;
    double c0, c1, c2, c3, c4;
};

SOFTGRAIN_INLINE Quartic quartic_about(Vector guess, Vector d, double xx, double xy, double yx, double yy) {
    // Length 1 but for rounding to float: the error left is its cube.
    const double excess = dot(guess, guess) - 1.0;
    const double scale = 1.0 - excess * (0.5 - 0.375 * excess);
    const Vector u{scale * guess.x, scale * guess.y};
    const Vector p{xx * u.x + xy * u.y, yx * u.x + yy * u.y};        // B u
    const Vector tangent{xy * u.x - xx * u.y, yy * u.x - yx * u.y};  // B v
    const Vector near{d.x + p.x, d.y + p.y}, far{d.x - p.x, d.y - p.y};
    return {u,
            dot(near, near) - 1.0,
            4.0 * dot(near, tangent),
            4.0 * dot(tangent, tangent) + 2.0 * (dot(near, far) - 1.0),
            4.0 * dot(tangent, far),
            dot(far, far) - 1.0};
}

struct Fraction {
    double num, den;
};

/// Koenig's step of order 5 from t = 0: the ratio of two consecutive Taylor coefficients of 1/quartic.
SOFTGRAIN_INLINE Fraction first_step(const Quartic& q) {
    const double e2 = q.c0 * q.c2, square = q.c0 * q.c0, e3 = square * q.c3, e4 = square * (q.c0 * q.c4);
    const double d2 = q.c1 * q.c1 - e2;
    const double d3 = q.c1 * (d2 - e2) + e3;
    const double d4 = q.c1 * (d3 + e3) - e2 * d2 - e4;
    return {-q.c0 * d3, d4};
}

/// Halley's step from t.
struct SecondStep {
    double value, slope;  // quartic and derivative at t
    Fraction step;
};
SOFTGRAIN_INLINE SecondStep second_step(const Quartic& q, double t) {
    const double c4t = q.c4 * t;
    const double value = q.c0 + t * (q.c1 + t * (q.c2 + t * (q.c3 + c4t)));
    const double slope = q.c1 + t * (2.0 * q.c2 + t * (3.0 * q.c3 + 4.0 * c4t));
    const double half_curvature = q.c2 + t * (3.0 * q.c3 + 6.0 * c4t);
    return {value, slope, {-value * slope, slope * slope - value * half_curvature}};
}

/// u(t); `inverse` is 1/(1 + t^2) but for a small relative error, of which the cube is left.
SOFTGRAIN_INLINE Vector turned(Vector u, double t, double inverse) {
    const double square = t * t;
    const double error = 1.0 - (1.0 + square) * inverse;
    const double scale = inverse + inverse * (error + error * error);
    const double c = (1.0 - square) * scale, s = 2.0 * t * scale;
    return {c * u.x - s * u.y, c * u.y + s * u.x};
}

SOFTGRAIN_INLINE void find_level(const ChordBatch& in, Work& w, int k) {
    const double det = in.a_xx[k] * in.a_yy[k] - in.a_xy[k] * in.a_yx[k], inverse = 1.0 / det;
    const double pxx = in.a_yy[k] * inverse, pxy = -in.a_xy[k] * inverse;
    const double pyx = -in.a_yx[k] * inverse, pyy = in.a_xx[k] * inverse;
    const double dx = pxx * in.dx[k] + pxy * in.dy[k], dy = pyx * in.dx[k] + pyy * in.dy[k];
    const double xx = pxx * in.b_xx[k] + pxy * in.b_yx[k], xy = pxx * in.b_xy[k] + pxy * in.b_yy[k];
    const double yx = pyx * in.b_xx[k] + pyy * in.b_yx[k], yy = pyx * in.b_xy[k] + pyy * in.b_yy[k];
    const double bx = xx * dx + yx * dy, by = xy * dx + yy * dy;
    const double difference = (xx * xx + yx * yx) - (xy * xy + yy * yy), mixed = 2.0 * (xx * xy + yx * yy);
    w.one_minimum[k] = bx * bx + by * by - (difference * difference + mixed * mixed);
    w.det_a[k] = det;
    w.det_b[k] = in.b_xx[k] * in.b_yy[k] - in.b_xy[k] * in.b_yx[k];
    w.dx[k] = dx, w.dy[k] = dy;
    w.xx[k] = xx, w.xy[k] = xy, w.yx[k] = yx, w.yy[k] = yy;
}

/// Two steps for both ends; the ends share their divisions.
SOFTGRAIN_INLINE void find_ends(const ChordBatch& in, Work& w, int k) {
    const Vector d{w.dx[k], w.dy[k]};
    const Quartic a = quartic_about({in.end_ax[k], in.end_ay[k]}, d, w.xx[k], w.xy[k], w.yx[k], w.yy[k]);
    const Quartic b = quartic_about({in.end_bx[k], in.end_by[k]}, d, w.xx[k], w.xy[k], w.yx[k], w.yy[k]);
    const Fraction fa = first_step(a), fb = first_step(b);
    const double both = 1.0 / (fa.den * fb.den);
    const double ta = fa.num * (fb.den * both), tb = fb.num * (fa.den * both);
    const SecondStep sa = second_step(a, ta), sb = second_step(b, tb);
    const double na = 1.0 + ta * ta, nb = 1.0 + tb * tb;
    const double dens = sa.step.den * sb.step.den, norms = na * nb, all = 1.0 / (dens * norms);
    const double by_dens = norms * all, by_norms = dens * all;
    const Vector end_a = turned(a.u, ta + sa.step.num * (sb.step.den * by_dens), nb * by_norms);
    const Vector end_b = turned(b.u, tb + sb.step.num * (sa.step.den * by_dens), na * by_norms);
    w.ax[k] = end_a.x, w.ay[k] = end_a.y;
    w.bx[k] = end_b.x, w.by[k] = end_b.y;
    w.value_a[k] = sa.value, w.slope_a[k] = sa.slope;
    w.value_b[k] = sb.value, w.slope_b[k] = sb.slope;
}

/// Chord, depths, and whether to trust them.
SOFTGRAIN_INLINE void finish_chord(ChordBatch& out, Work& w, int k) {
    // Of the last step, next to the opening's sine; of that sine: as in chord.hpp.
    constexpr double settled = 5e-6, smallest = 1e-3, rounding = 1e-14;
    const Vector a{w.ax[k], w.ay[k]}, b{w.bx[k], w.by[k]};
    const Vector t{b.x - a.x, b.y - a.y}, m{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};  // b's unit frame
    const Vector s{w.xx[k] * t.x + w.xy[k] * t.y, w.yx[k] * t.x + w.yy[k] * t.y};   // a's
    const Vector p{w.dx[k] + w.xx[k] * m.x + w.xy[k] * m.y, w.dy[k] + w.yx[k] * m.x + w.yy[k] * m.y};
    const Vector c{out.b_xx[k] * t.x + out.b_xy[k] * t.y, out.b_yx[k] * t.x + out.b_yy[k] * t.y};
    const double sine2_a = dot(s, s), sine2_b = dot(t, t);      // 4 sin^2(psi)
    const double twice_a = cross(s, p), twice_b = cross(m, t);  // sin(2 psi)
    const double sine_a = std::sqrt(sine2_a), sine_b = std::sqrt(sine2_b);
    const double sum_a = sine_a + twice_a, sum_b = sine_b + twice_b;
    const double length = std::sqrt(dot(c, c));
    const double sums = sum_a * sum_b, all = 1.0 / (sums * length), by_sums = length * all;
    // q = tan(psi/2) = sin(psi)/(1 + cos(psi)); depth = |A^T n| sin(psi) q and |A^T n| L = det A 2
    // sin(psi).
    const double q_a = 0.5 * sine2_a * (sum_b * by_sums), q_b = 0.5 * sine2_b * (sum_a * by_sums);
    out.depth[k] = 0.5 * (w.det_a[k] * sine2_a * q_a + w.det_b[k] * sine2_b * q_b) * (sums * all);
    w.q_a[k] = q_a, w.q_b[k] = q_b;
    w.y_a[k] = 0.25 * sine_a * q_a, w.y_b[k] = 0.25 * sine_b * q_b;
    out.chord_x[k] = -c.y, out.chord_y[k] = c.x;
    out.mid_x[k] = out.dx[k] + out.b_xx[k] * m.x + out.b_xy[k] * m.y;
    out.mid_y[k] = out.dy[k] + out.b_yx[k] * m.x + out.b_yy[k] * m.y;
    out.cover_a[k] = 0.5 * twice_a, out.cover_b[k] = 0.5 * twice_b;

    const double band = 0.25 * settled * settled * sine2_b;
    const bool found = (w.value_a[k] * w.value_a[k] <= band * (w.slope_a[k] * w.slope_a[k])) &
                       (w.value_b[k] * w.value_b[k] <= band * (w.slope_b[k] * w.slope_b[k]));
    const bool sides = (w.slope_a[k] < 0.0) & (w.slope_b[k] > 0.0);
    const bool sizes = (sine2_b > 4.0 * smallest * smallest) & (twice_a >= 0.0) & (twice_b >= 0.0);
    // A guess far from any chord may leave the circle.
    const bool on_circle = (std::abs(dot(a, a) - 1.0) < rounding) & (std::abs(dot(b, b) - 1.0) < rounding);
    const bool sound = found & sides & sizes & on_circle & (w.one_minimum[k] > 0.0);
    out.sound[k] = sound ? 1.0 : 0.0;
    out.end_ax[k] = sound ? a.x : out.end_ax[k];
    out.end_ay[k] = sound ? a.y : out.end_ay[k];
    out.end_bx[k] = sound ? b.x : out.end_bx[k];
    out.end_by[k] = sound ? b.y : out.end_by[k];
}

/// Caps from q, y and, in cover_a and cover_b, sin(psi) cos(psi).
SOFTGRAIN_INLINE void find_caps(ChordBatch& out, const Work& w, int k) {
    const double area_a = w.q_a[k] * w.y_a[k] * cap_series(w.y_a[k]);
    const double area_b = w.q_b[k] * w.y_b[k] * cap_series(w.y_b[k]);
    out.cover_a[k] += area_a, out.cover_b[k] += area_b;
    out.cap_a[k] = w.det_a[k] * area_a, out.cap_b[k] = w.det_b[k] * area_b;
}

}  // namespace

SOFTGRAIN_CLONES void solve_chords(ChordBatch& batch) {
    constexpr int width = 8;  // whole registers only
    const int lanes = (batch.count + width - 1) / width * width;
    Work work;
#pragma omp simd
    for (int k = 0; k < lanes; ++k) find_level(batch, work, k);
#pragma omp simd
    for (int k = 0; k < lanes; ++k) find_ends(batch, work, k);
#pragma omp simd
    for (int k = 0; k < lanes; ++k) finish_chord(batch, work, k);
#pragma omp simd
    for (int k = 0; k < lanes; ++k) find_caps(batch, work, k);
}

}  // namespace softgrain::sdem
