#pragma once
// Solves K x = b for the stiffness of all grains and their contacts.
#include <span>
#include <vector>

#include "mpm/contact/contact_model.hpp"
#include "mpm/grains.hpp"

namespace softgrain::mpm {

/// Stiffness as the sum of its parts.
struct Stiffness {
    std::vector<Mat2> grain;                ///< [grains * pattern size] lower triangles
    std::vector<ContactStiffness> contact;  ///< by groups
    double shift = 0.0;                     ///< added to the diagonal [N/m]
    double contact_shift = 0.0;             ///< added to that of nodes of contacts besides [N/m]
};

class LinearSolver {
  public:
    virtual ~LinearSolver() = default;
    /// What grains do alone, and which nodes contacts touch. False if it is not positive definite.
    virtual bool factor_grains(const Stiffness& K) = 0;
    /// The rest, for the same grains and nodes: once or more. False if K is not positive definite; it is then
    /// not to be solved with.
    virtual bool factor_contacts(const Stiffness& K) = 0;
    /// Takes K as last factored and these springs instead. False if this is not worth while, or K is not
    /// positive definite: it is then to be factored.
    virtual bool change_contacts(std::span<const ContactSpring>) { return false; }

    /// Begins to solve K x = b + c for forces c that change only nodes of contacts; b [all nodes].
    virtual void begin(std::span<const Vec2> b) = 0;
    /// x of the nodes of contacts for these c [all nodes]; others of x are not to be used yet.
    virtual void solve_contacts(std::span<const Vec2> c, std::span<Vec2> x) = 0;
    /// The rest of the last x.
    virtual void finish(std::span<Vec2> x) = 0;
};

}  // namespace softgrain::mpm
