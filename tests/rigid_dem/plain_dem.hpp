#pragma once
// Rigid DEM as one would write it down: every pair of discs looked at in every step, one after the other.
#include <Eigen/Geometry>
#include <map>

#include "common/packing/disc_union.hpp"
#include "common/packing/packing.hpp"
#include "rigid_dem/laws/contact.hpp"
#include "rigid_dem/parameters.hpp"

namespace softgrain::rigid_dem::testing {

class PlainDem {
  public:
    /// Gap at which no bond of the tests is left [m].
    static constexpr double out_of_reach = 0.5;

    PlainDem(const Scenario& scenario, const Packing& packing)
        : x(packing.center), law_(parameters_of(scenario)), box_(packing.box), angle_(packing.angle) {
        angle_.resize(x.size(), 0.0);
        for (std::size_t g = 0; g < x.size(); ++g) {
            const Material& m = scenario.material_of(packing.class_of(g));
            const std::vector<Disc> discs = packing.discs_of(g);
            const UnionMoments body = union_moments(discs);
            mass_.push_back(m.density * body.area);
            inertia_.push_back(m.density * body.polar_moment);
            for (const Disc& disc : discs) {
                const Vec2 arm = disc.center - x[g];
                parts_.push_back({g,
                                  Eigen::Rotation2Dd(-angle_[g]) * arm,
                                  disc.radius,
                                  {disc.radius, m.youngs_modulus, m.poisson_ratio},
                                  1.0 / mass_[g] + arm.squaredNorm() / inertia_[g]});
            }
        }
        v.assign(x.size(), Vec2::Zero());
        spin.assign(x.size(), 0.0);
        find_forces({box_, {}, 0.0}, 0.0);
        if (law_.bonds_of_start_only) law_.between_grains.sticks = 0.0;
    }

    void advance(const WallMotion& walls, double dt) {
        const double share = law_.nonviscous_damping;
        const auto damped = [&](double f, double velocity) {
            return f * velocity == 0.0 ? f : f * velocity > 0.0 ? f - share * f : f + share * f;
        };
        for (std::size_t g = 0; g < x.size(); ++g) {
            if (box_.periodic) v[g] += walls.affine_velocity(x[g]) - before_.affine_velocity(x[g]);
            const Vec2 flow = box_.periodic ? walls.affine_velocity(x[g]) : Vec2::Zero();
            for (int k = 0; k < 2; ++k) v[g][k] += damped(force_[g][k], v[g][k] - flow[k]) * dt / mass_[g];
            spin[g] += damped(torque_[g], spin[g]) * dt / inertia_[g];
            x[g] += v[g] * dt;
            angle_[g] += spin[g] * dt;
        }
        box_ = walls.after(dt);
        before_ = {box_, walls.velocity, walls.tilt_rate};
        find_forces(before_, dt);
    }

    std::vector<Vec2> x, v;
    std::vector<double> spin;

  private:
    ContactForce answer(const ContactInput& in, ContactMemory& memory, const LawConstants& law, double dt) {
        constexpr unsigned elastic = has_damping | has_friction | has_rolling;
        return law_.hertz ? contact_force<Hertz, elastic>(in, memory, law, dt)
                          : contact_force<Linear, every_part>(in, memory, law, dt);
    }

    void find_forces(const WallMotion& walls, double dt) {
        before_ = walls;
        force_.assign(x.size(), Vec2::Zero());
        torque_.assign(x.size(), 0.0);
        std::vector<Vec2> arm, velocity;
        for (const Part& part : parts_) {
            arm.push_back(Eigen::Rotation2Dd(angle_[part.body]) * part.local);
            velocity.push_back(v[part.body] + spin[part.body] * perpendicular(arm.back()));
        }
        const auto push = [&](std::size_t i, const Vec2& force, double torque) {
            force_[parts_[i].body] += force;
            torque_[parts_[i].body] += cross(arm[i], force) + torque;
        };
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const Part& a = parts_[i];
            for (std::size_t j = i + 1; j < parts_.size(); ++j) {
                const Part& b = parts_[j];
                if (a.body == b.body) continue;
                Vec2 to_j = x[b.body] + arm[j] - x[a.body] - arm[i], dv = velocity[j] - velocity[i];
                if (box_.periodic) {
                    const Image image = box_.nearest_image(to_j);
                    to_j += box_.image(image);
                    dv += walls.image_velocity(image);
                }
                const double overlap = a.radius + b.radius - to_j.norm();
                if (overlap < -out_of_reach) continue;
                const Vec2 n = to_j.normalized(), s = perpendicular(n);
                const ContactStiffness stiffness = stiffness_of_pair(law_, a.elasticity, b.elasticity);
                const double arm_i = a.radius - 0.5 * overlap, arm_j = b.radius - 0.5 * overlap;
                const ContactInput in{.overlap = overlap,
                                      .closing = -dv.dot(n),
                                      .slip = dv.dot(s) - arm_i * spin[a.body] - arm_j * spin[b.body],
                                      .spin_difference = spin[a.body] - spin[b.body],
                                      .k = stiffness.k,
                                      .shear_ratio = stiffness.shear_ratio,
                                      .shear_compliance = 1.0 / (stiffness.k * stiffness.shear_ratio),
                                      .inverse_mass = a.inverse_mass + b.inverse_mass,
                                      .rolling_radius = a.radius * b.radius / (a.radius + b.radius),
                                      .adhesive_length = 2.0 * std::min(a.radius, b.radius)};
                const ContactForce f = answer(in, memory_[{i, j}], law_.between_grains, dt);
                const Vec2 on_i = f.shear * s - f.normal * n;
                push(i, on_i, arm_i * f.shear + f.moment);
                push(j, -on_i, arm_j * f.shear - f.moment);
            }
            for (int w = 0; w < 4 && !box_.periodic; ++w) {
                const Vec2 n = -wall_normal(w), s = perpendicular(n);
                const Vec2 dv = walls.velocity_of(w) - velocity[i];
                const double overlap = a.radius - box_.distance(w, x[a.body] + arm[i]);
                const double lever = a.radius - 0.5 * overlap;
                const ContactStiffness stiffness = stiffness_at_wall(law_, a.elasticity);
                const ContactInput in{
                    .overlap = overlap,
                    .closing = -dv.dot(n),
                    .slip = dv.dot(s) - lever * spin[a.body],
                    .spin_difference = spin[a.body],
                    .k = stiffness.k,
                    .shear_ratio = stiffness.shear_ratio,
                    .shear_compliance = 1.0 / (stiffness.k * stiffness.shear_ratio),
                    .inverse_mass = a.inverse_mass,
                    .rolling_radius = a.radius,
                };
                const ContactForce f =
                    answer(in, memory_[{i, parts_.size() + static_cast<std::size_t>(w)}], law_.at_walls, dt);
                push(i, f.shear * s - f.normal * n, lever * f.shear + f.moment);
            }
        }
    }

    /// A disc of a body, fixed in its frame.
    struct Part {
        std::size_t body;
        Vec2 local;
        double radius;
        GrainElasticity elasticity;
        double inverse_mass;  ///< that contacts see
    };
    std::vector<Part> parts_;
    Parameters law_;
    Box box_;
    WallMotion before_;
    std::vector<double> angle_, mass_, inertia_, torque_;
    std::vector<Vec2> force_;
    std::map<std::pair<std::size_t, std::size_t>, ContactMemory> memory_;
};

}  // namespace softgrain::rigid_dem::testing
