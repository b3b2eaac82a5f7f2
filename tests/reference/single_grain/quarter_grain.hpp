#pragma once
// A quarter of one soft disc pressed between frictionless rigid walls: quasi-static total-Lagrangian finite
// elements, unilateral contact at the nodes of the outline.
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "mesh.hpp"
#include "neo_hookean.hpp"

namespace softgrain::reference {

/// Two walls across y, or 4, 6 or 8 that make a regular polygon, one of them across x.
enum class Walls { two = 2, four = 4, six = 6, eight = 8 };

/// One point of the curve; forces and energies are those of the whole disc, per unit thickness.
struct GrainState {
    double wall_displacement;                                        ///< e, in radii
    double force;                                                    ///< on the wall across y [N]
    double contact_length, contact_length_low, contact_length_high;  ///< [m]
    double area_ratio;                                               ///< deformed / initial area
    double pressure_centre, pressure_max;                            ///< at the wall [Pa]
    double half_width;                                               ///< largest |x| [m]
    double energy;                                                   ///< [J]
    double smallest_J;
    int iterations;
};

class QuarterGrain {
  public:
    /// `volume_points`: Gauss points along each side for the volumetric energy, 3 (full) or 2 (reduced: the
    /// pressure of nearly incompressible grains does not lock).
    QuarterGrain(double radius, int elements_per_side, const Material& material, Walls walls,
                 int volume_points);

    /// Moves all walls to displacement e and finds equilibrium; std::nullopt (state unchanged) if Newton
    /// fails.
    std::optional<GrainState> press(double e);

  private:
    struct Point {
        int element;
        bool shape, volume;  ///< which energies are integrated here
        double weight;
        Eigen::Matrix<double, 9, 2> gradient;
    };
    enum class Constraint : char { free, symmetry, wall };

    void place_walls(Walls walls);
    void place_points(int order, bool shape, bool volume);
    Tensor deformation(const Point& point) const;
    /// Internal forces, and the tangent if `tangent`; false if a det F <= 0.
    bool assemble(bool tangent);
    double reference(Eigen::Index dof) const;
    bool update_contacts(double limit);
    bool solve(double limit);
    GrainState measure(double e, int iterations) const;

    double radius_;
    Mesh mesh_;
    Material material_;
    int measured_axis_;               ///< of the wall whose contact is measured
    std::vector<Mat2> frame_;         ///< per node: columns are the directions of its degrees of freedom
    std::vector<int> facing_a_wall_;  ///< degrees of freedom along the normal of a wall
    std::vector<Point> points_;
    std::vector<Constraint> constraint_;  ///< per degree of freedom
    Eigen::VectorXd displacement_, force_;
    Eigen::SparseMatrix<double> tangent_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
    bool analysed_ = false;
};

}  // namespace softgrain::reference
