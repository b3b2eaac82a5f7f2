#pragma once
// What a contact is once its geometry and its local force are known. One cache line. Free of Eigen.
#include <algorithm>

namespace softgrain::sdem {

/// A candidate pair, or a grain at a wall. All zero where nothing touches.
struct alignas(64) Contact {
    double chord_x, chord_y;  ///< L n: chord length times unit normal out of i [m]
    double arm_x, arm_y;      ///< from the centre of i to the mid-point of the chord [m]
    double cap_i, cap_j;      ///< S, area of each ellipse beyond the chord [m^2]
    double q;                 ///< elastic normal force per chord length [N/m], compression positive
    double q_damping;         ///< the same of the dashpot [N/m], before it is kept from pulling

    bool touching() const { return cap_i > 0.0; }
    double lens() const { return cap_i + cap_j; }
    double length_squared() const { return chord_x * chord_x + chord_y * chord_y; }
};
static_assert(sizeof(Contact) == 64);

/// A dashpot may at most cancel the compression.
inline double damping_without_pull(double q, double q_damping) {
    return std::max(q_damping, -std::max(q, 0.0));
}

/// The ends of a contact's last chord (see WarmStart). A guess only: single precision is enough.
struct ChordGuess {
    float ax = 0.0F, ay = 0.0F, bx = 0.0F, by = 0.0F;
};

/// Half opening angles of a contact's caps.
struct Opening {
    float psi_i = 0.0F, psi_j = 0.0F;
};

}  // namespace softgrain::sdem
