#pragma once
// Energy, forces and stiffness of one grain by its own deformation.
#include <span>
#include <vector>

#include "mpm/grains.hpp"

namespace softgrain::mpm {

/// Storage for the evaluation of one grain, kept from one to the next.
class GrainForces {
  public:
    /// mean_dilatation: U(J) of laws that split is taken at the mean J of each cell, without which grains
    /// lock towards nu = 0.5.
    GrainForces(const ReferenceDisc& disc, const StiffnessPattern& pattern, bool mean_dilatation);

    /// Deformation gradient at the material points: q [nodes].
    std::span<const Mat2> deformation(const Grain& grain, std::span<const Vec2> q);

    /// Energy [J]; infinite where a cell is inside out. state [points] or empty. Adds dU/dq to `force`
    /// [nodes] and, if not empty, writes d2U/dq2 to `stiffness` [pattern size].
    double evaluate(const Grain& grain, std::span<const Vec2> q, std::span<const PlasticState> state,
                    std::span<Vec2> force, std::span<Mat2> stiffness);

    /// Of the last evaluate() or deformation(q).
    std::span<const Mat2> deformation() const { return F_; }
    /// Of the last deformation(q): sum of U(J), of laws that split [J].
    double volumetric_energy(const Grain& grain) const;
    /// Kirchhoff stress zz at a point, tension positive; after evaluate() [N/m].
    double stress_out_of_plane(const Grain& grain, std::size_t point) const;
    /// First Piola-Kirchhoff stress at the points, as it drives the nodes [N/m]; after evaluate().
    std::span<const Vec4> stress() const { return stress_; }

  private:
    void add_cell_stiffness(const Cell& cell, std::size_t number, const Grain& grain,
                            std::span<Mat2> stiffness);

    const ReferenceDisc& disc_;
    const StiffnessPattern& pattern_;
    bool mean_dilatation_;
    std::vector<Mat2> F_;
    std::vector<Response> response_;
    std::vector<Vec4> stress_;
    std::vector<Mat4> tangent_;  ///< weighted, by the gradient in the unit disc
    std::vector<double> cell_curvature_;
    std::vector<Vec4> cofactor_;
    std::vector<double> slope_;  ///< dU/dJ
    Eigen::MatrixXd gradient_, image_, block_[3];
    Eigen::VectorXd dilatation_;
};

}  // namespace softgrain::mpm
