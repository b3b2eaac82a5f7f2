#pragma once
// What a contact is once its geometry and its local force are known.
#include <algorithm>

namespace softgrain::sdem {

/// A candidate pair, or a grain at a wall. All zero where nothing touches.
struct Contact {
    double chord_x, chord_y;  ///< L n: chord length times unit normal out of i [m]
    double arm_ix, arm_iy;    ///< from the centre of i to the mid-point of the chord [m]
    double arm_jx, arm_jy;    ///< the same from the centre of j
    double cap_i, cap_j;      ///< S, area of each ellipse beyond the chord [m^2]
    double q;  ///< normal force per chord length without the grains' pressure [N/m], compression positive
    double q_damping;    ///< the same of the dashpot [N/m], before it is kept from pulling
    double share_i;      ///< beta_i, share of the overlap that grain i gives way to
    float psi_i, psi_j;  ///< half opening angles of the caps
    float stiffness;     ///< d(force)/d(approach), for the time step [N/m]
    float depth;         ///< overlap of both ellipses along n [m]

    bool touching() const { return depth > 0.0F; }
};

/// A dashpot may at most cancel the compression.
inline double damping_without_pull(double q, double q_damping) {
    return std::max(q_damping, -std::max(q, 0.0));
}

}  // namespace softgrain::sdem
