#pragma once
// What a contact law may look at, and what it answers.

namespace softgrain::sdem {

/// A contact as its law sees it. At a wall: the full depth.
struct ContactInput {
    double length;  ///< L_c [m]
    double delta;   ///< -delta_n of Eq. 54: half of the overlap of two grains, all of it at a wall [m]
    double rate;    ///< d(delta)/dt, positive while closing [m/s]
    double E;       ///< harmonic mean of both grains' E [N/m]
    double mass;    ///< 1/(1/m_i + 1/m_j) [kg]
};

/// Force per chord length.
struct ContactAnswer {
    double q;          ///< elastic, as far as it is the contact's alone; compression positive [N/m]
    double q_damping;  ///< of the dashpot [N/m]
    double stiffness;  ///< of the force against the approach [N/m]; <= 0 if the law fails
};

}  // namespace softgrain::sdem
