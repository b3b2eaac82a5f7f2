#pragma once
// Rigid DEM as one would write it down: every pair looked at in every step, one after the other.
#include <map>
#include <numbers>

#include "common/packing/packing.hpp"
#include "rigid_dem/laws/contact.hpp"
#include "rigid_dem/parameters.hpp"

namespace softgrain::rigid_dem::testing {

class PlainDem {
  public:
    /// Gap at which no bond of the tests is left [m].
    static constexpr double out_of_reach = 0.5;

    PlainDem(const Scenario& scenario, const Packing& packing)
        : x(packing.center), law_(parameters_of(scenario)), box_(packing.box), radius_(packing.radius) {
        for (std::size_t g = 0; g < x.size(); ++g) {
            const Material& m = scenario.material_of(packing.class_of(g));
            elasticity_.push_back({radius_[g], m.youngs_modulus, m.poisson_ratio});
            mass_.push_back(m.density * std::numbers::pi * radius_[g] * radius_[g]);
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
            const double inertia = 0.5 * mass_[g] * radius_[g] * radius_[g];
            for (int k = 0; k < 2; ++k) v[g][k] += damped(force_[g][k], v[g][k] - flow[k]) * dt / mass_[g];
            spin[g] += damped(torque_[g], spin[g]) * dt / inertia;
            x[g] += v[g] * dt;
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
        for (std::size_t i = 0; i < x.size(); ++i) {
            for (std::size_t j = i + 1; j < x.size(); ++j) {
                Vec2 to_j = x[j] - x[i], dv = v[j] - v[i];
                if (box_.periodic) {
                    const Image image = box_.nearest_image(to_j);
                    to_j += box_.image(image);
                    dv += walls.image_velocity(image);
                }
                const double overlap = radius_[i] + radius_[j] - to_j.norm();
                if (overlap < -out_of_reach) continue;
                const Vec2 n = to_j.normalized(), s = perpendicular(n);
                const ContactStiffness stiffness = stiffness_of_pair(law_, elasticity_[i], elasticity_[j]);
                const double arm_i = radius_[i] - 0.5 * overlap, arm_j = radius_[j] - 0.5 * overlap;
                const ContactInput in{.overlap = overlap,
                                      .closing = -dv.dot(n),
                                      .slip = dv.dot(s) - arm_i * spin[i] - arm_j * spin[j],
                                      .spin_difference = spin[i] - spin[j],
                                      .k = stiffness.k,
                                      .shear_ratio = stiffness.shear_ratio,
                                      .shear_compliance = 1.0 / (stiffness.k * stiffness.shear_ratio),
                                      .inverse_mass = 1.0 / mass_[i] + 1.0 / mass_[j],
                                      .rolling_radius = radius_[i] * radius_[j] / (radius_[i] + radius_[j]),
                                      .adhesive_length = 2.0 * std::min(radius_[i], radius_[j])};
                const ContactForce f = answer(in, memory_[{i, j}], law_.between_grains, dt);
                const Vec2 on_i = f.shear * s - f.normal * n;
                force_[i] += on_i;
                force_[j] -= on_i;
                torque_[i] += arm_i * f.shear + f.moment;
                torque_[j] += arm_j * f.shear - f.moment;
            }
            for (int w = 0; w < 4 && !box_.periodic; ++w) {
                const Vec2 n = -wall_normal(w), s = perpendicular(n);
                const Vec2 dv = walls.velocity_of(w) - v[i];
                const double overlap = radius_[i] - box_.distance(w, x[i]), arm = radius_[i] - 0.5 * overlap;
                const ContactStiffness stiffness = stiffness_at_wall(law_, elasticity_[i]);
                const ContactInput in{
                    .overlap = overlap,
                    .closing = -dv.dot(n),
                    .slip = dv.dot(s) - arm * spin[i],
                    .spin_difference = spin[i],
                    .k = stiffness.k,
                    .shear_ratio = stiffness.shear_ratio,
                    .shear_compliance = 1.0 / (stiffness.k * stiffness.shear_ratio),
                    .inverse_mass = 1.0 / mass_[i],
                    .rolling_radius = radius_[i],
                };
                const ContactForce f =
                    answer(in, memory_[{i, x.size() + static_cast<std::size_t>(w)}], law_.at_walls, dt);
                force_[i] += f.shear * s - f.normal * n;
                torque_[i] += arm * f.shear + f.moment;
            }
        }
    }

    Parameters law_;
    Box box_;
    WallMotion before_;
    std::vector<double> radius_, mass_, torque_;
    std::vector<GrainElasticity> elasticity_;
    std::vector<Vec2> force_;
    std::map<std::pair<std::size_t, std::size_t>, ContactMemory> memory_;
};

}  // namespace softgrain::rigid_dem::testing
