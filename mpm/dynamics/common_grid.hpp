#pragma once
// Contact at the nodes of a grid that all grains share (multi-mesh; Nezamabadi et al. 2015, 2017; normals of
// Huang et al. 2011). For comparison with contact of surfaces: it keeps grains apart by a cell or more.
#include <array>
#include <compare>
#include <span>
#include <vector>

#include "common/box.hpp"
#include "common/checkpoint.hpp"
#include "common/grain_view.hpp"
#include "mpm/dynamics/mass.hpp"
#include "mpm/grains.hpp"

namespace softgrain::mpm {

struct CommonGridSettings {
    double friction = 0.0, wall_friction = 0.0;  ///< Coulomb coefficients
    double tolerance = 1e-3;  ///< change of impulses in the last sweep / impulses, in energy norm
    int most_sweeps = 100;
};

/// A fixed square grid with bilinear shape functions S_I, as wide as the grid of a grain of mean radius.
/// Material points bring mass m_I = sum m_p S_I(x_p) and momentum of their grain to its nodes. Where two
/// grains have mass at a node, velocity-Signorini and Coulomb conditions hold between them, the normal along
/// the difference of their mass gradients; a wall is a body that fills the outside, with mass at nodes less
/// than a cell from it. Impulses return by the adjoint map, r_I = sum_p m_p S_I N / m_I by coefficient,
/// through M^-1: momentum is conserved to rounding, angular momentum but for the moment of impulses between
/// the centres of both masses at a node.
///
/// Each sweep corrects all nodes as if their masses were lumped there, as in the paper. The coupled nodes
/// have at most that compliance, so that repeated sweeps from the impulses of the last step converge; they
/// are accelerated (Nesterov 1983, restarted as by O'Donoghue and Candes 2015).
class CommonGrid {
  public:
    CommonGrid(const Grains& grains, const Mass& mass, const CommonGridSettings& settings);

    /// Changes velocities v as contacts ask for in a step of dt from positions q. last: velocities before
    /// forces acted in this step, which the work of impulses is counted from. wall_velocity [m/s].
    void collide(std::span<const Vec2> q, std::span<const Vec2> last, std::span<Vec2> v, const Box& box,
                 const std::array<Vec2, 4>& wall_velocity, double dt);
    void save(Checkpoint& to) const;
    /// Throws InputError if what was saved is broken.
    void load(const Checkpoint& from);
    /// Forgets the impulses of the last step, with which sweeps begin.
    void forget() { contact_.clear(); }

    double spacing() const { return spacing_; }  ///< [m]
    // Of the last step.
    const std::array<Vec2, 4>& wall_force() const { return wall_force_; }  ///< by grains on walls [N]
    double impact() const { return impact_; }                              ///< dissipated along normals [J]
    double friction() const { return friction_; }                          ///< dissipated by sliding [J]
    double work_of_walls() const { return work_of_walls_; }                ///< on grains [J]
    int sweeps() const { return sweeps_; }
    double unconverged_steps() const { return unconverged_steps_; }  ///< since the start
    /// Mean forces, sorted by (i, j), walls first. Lengths are 0.
    std::vector<GrainContact> grain_contacts() const;

  private:
    /// What a grain brings to the nodes around it.
    struct Window {
        int x0, y0, nx, ny;          ///< nodes [x0, x0 + nx) x [y0, y0 + ny)
        std::vector<Vec2> point;     ///< material points
        std::vector<double> mass;    ///< 0 if it does not count
        std::vector<Vec2> gradient;  ///< of mass
        std::vector<int> row;        ///< of each node in `rows`, or -1
        std::vector<int> share;      ///< by row
        ShapeRows rows;              ///< r_I of nodes with contact
    };
    /// A grain with mass at a node.
    struct NodeMass {
        int y, x, grain;
        auto operator<=>(const NodeMass&) const = default;
    };
    /// A grain at a node with contact.
    struct Share {
        int grain, row;
        double mass;
        Vec2 gradient;
        Vec2 velocity;
        Vec2 impulse;  ///< of this sweep
    };
    struct NodeContact {
        int x, y;       ///< node
        int i, j;       ///< grains i < j, or j = -1 - wall
        int a, b;       ///< shares of i and j
        Vec2 normal;    ///< unit, from j to i
        double mu;      ///< Coulomb coefficient
        double mass;    ///< reduced [kg]
        Vec2 approach;  ///< relative velocity of i before the step [m/s]
        Vec2 impulse;   ///< on i [N s]
        Vec2 before;    ///< impulse of the last sweep
        Vec2 ahead;     ///< impulse that the velocities are with
    };

    void fill(std::size_t g, std::span<const Vec2> q);
    /// Nodes that grains or a grain and a wall share, in rows from the bottom.
    void find_contacts(const Box& box);
    /// Of one node.
    void add_contacts(std::span<const NodeMass> grains, const Box& box);
    void find_rows(std::size_t g);
    /// Takes impulses of the last step for the same contacts.
    void remember(const std::vector<NodeContact>& before, double factor);
    void find_velocities(std::span<const Vec2> v);
    /// One sweep over nodes. Whether impulses have come to rest.
    bool sweep();
    /// Where the next sweep begins: impulses extrapolated, unless they turn back.
    void look_ahead();
    /// Of a contact to its shares.
    void push(const NodeContact& c, const Vec2& impulse);
    /// Impulses of shares to velocities, and none left.
    void apply(std::span<Vec2> v);
    Vec2 relative_velocity(const NodeContact& c) const;
    void take_stock(double dt);

    const Grains& grains_;
    const Mass& mass_;
    CommonGridSettings settings_;
    double spacing_;
    std::array<Vec2, 4> wall_velocity_;
    std::vector<Window> window_;  ///< [grains]
    std::vector<NodeMass> node_mass_;
    std::vector<Share> share_;
    std::vector<NodeContact> contact_;
    std::array<Vec2, 4> wall_force_;
    double momentum_ = 1.0;  ///< of the extrapolation
    double dt_ = 0.0;
    double impact_ = 0.0, friction_ = 0.0, work_of_walls_ = 0.0;
    int sweeps_ = 0;
    double unconverged_steps_ = 0.0;
};

}  // namespace softgrain::mpm
