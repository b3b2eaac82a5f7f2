#pragma once
// Quasi-static loading: the walls move by small steps, and after each the grains are brought to rest at a
// minimum of the energy. For laws that have one.
#include "sdem/solver.hpp"

namespace softgrain::sdem {

struct QuasiStaticOptions {
    double strain_step = 2.5e-4;  ///< largest strain of the box between two equilibria
    double tolerance = 1e-3;      ///< largest force out of balance / mean contact force
};

class QuasiStaticSolver final : public SoftDiscSolver {
  public:
    QuasiStaticSolver(std::vector<GrainMaterial> material, const Packing& packing, const Options& options,
                      const QuasiStaticOptions& quasi_static);

    double stable_time_step() const override;
    void advance(const WallMotion& walls, double dt) override;

  private:
    /// Sums over all grains, weighted with their inertia: what steers the descent.
    struct Descent {
        double power = 0.0, speed2 = 0.0, pull2 = 0.0;
        double worst = 0.0;           ///< largest force or moment / radius out of balance [N]
        std::size_t worst_grain = 0;  ///< the grain that feels it

        void note(double out_of_balance, std::size_t grain) {
            if (!(out_of_balance > worst)) return;
            worst = out_of_balance;
            worst_grain = grain;
        }
    };

    void carry_along(const Box& before, const Box& after);
    /// Fast inertial relaxation engine (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006), each grain with
    /// its own inertia. Returns the steps taken.
    int relax();
    Descent find_accelerations();
    void step(double keep, double turn, double dt);
    double mean_contact_force() const;
    void stop();
    double flow();

    QuasiStaticOptions quasi_static_;
    double mean_radius_;                ///< of the undeformed grains [m]
    std::vector<double> acceleration_;  ///< [6 n] of c and F
};

}  // namespace softgrain::sdem
