#pragma once
// Exact chords of many contacts at once: the method of chord.hpp without a branch, several contacts to a
// vector register. No Eigen here: the .cpp is compiled for other instruction sets than the rest.

namespace softgrain::sdem {

/// Up to `capacity` contacts side by side. Grain a is the larger of each pair (radius_a >= radius_b).
/// Lanes from `count` on may hold anything.
struct alignas(64) ChordBatch {
    static constexpr int capacity = 64;
    using Lanes = double[capacity];

    // In.
    alignas(64) Lanes dx{}, dy{};                      ///< centre of b minus centre of a [m]
    alignas(64) Lanes a_xx{}, a_xy{}, a_yx{}, a_yy{};  ///< axes of a: its outline is c + A u, |u| = 1 [m]
    alignas(64) Lanes b_xx{}, b_xy{}, b_yx{}, b_yy{};  ///< axes of b
    // In: first guess. Out, in sound lanes only: the ends of the chord in b's unit frame, counter-clockwise
    // over the cap (WarmStart a and b). A guess rounded to float is good enough.
    alignas(64) Lanes end_ax{}, end_ay{}, end_bx{}, end_by{};
    // Out; meaningless in lanes that are not sound.
    alignas(64) Lanes chord_x{}, chord_y{};  ///< L n: length of the chord times unit normal out of a [m]
    alignas(64) Lanes mid_x{}, mid_y{};      ///< mid-point of the chord minus centre of a [m]
    alignas(64) Lanes cap_a{}, cap_b{};      ///< area of each ellipse beyond the chord [m^2]
    alignas(64) Lanes cover_a{}, cover_b{};  ///< psi: half opening angle of each cap in its unit frame
    alignas(64) Lanes depth{};               ///< sum of both depths beyond the chord [m]
    alignas(64)
        Lanes sound{};  ///< 1; or 0: ask chord_of (cold start, opening, four points, a cap beyond 75 degrees)
    int count = 0;
};

/// Chords of the first `count` lanes from the ends of the last call. A lane's bits depend on nothing but its
/// own input: not on its place, its neighbours or the instruction set.
void solve_chords(ChordBatch& batch);

}  // namespace softgrain::sdem
