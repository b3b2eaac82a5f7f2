#include "sdem/motion_block.hpp"

#include "common/simd.hpp"
#include "sdem/dilation_inertia.hpp"
#include "sdem/kinematics.hpp"
#include "sdem/laws/lens_potential.hpp"
#include "sdem/laws/mollon2022.hpp"
#include "sdem/laws/plastic_flow.hpp"

namespace softgrain::sdem {

namespace {

/// Moments so far are about the present shape: sum f (x) r. Those conjugate to F are sum f (x) r F^-T.
SOFTGRAIN_INLINE Tensor pulled_back(const Tensor& moment, const Tensor& F) {
    return (1.0 / F.det()) * (moment * F.cofactor());
}

template <GrainLaw law, ContactLaw contact, bool imposes_area>
SOFTGRAIN_INLINE void stress_lanes(MotionBlock& block) {
#pragma omp simd
    for (int l = 0; l < block.count; ++l) {
        const Tensor F = block.F[l];
        const double J = F.det(), mu = block.mu[l], kappa = block.kappa[l];
        Tensor P;
        if constexpr (law == GrainLaw::neo_hookean)
            P = (mu / J) * (F - (0.5 * F.squared() / J) * F.cofactor());
        else
            P = linear_piola(F, mu, 0.0, 0.0);
        if constexpr (contact == ContactLaw::lens_potential) {
            P = P - block.pressure[l] * F.cofactor();
        } else if constexpr (!imposes_area) {
            const double ratio = J - block.caps[l];  // Eq. 41
            if constexpr (law == GrainLaw::neo_hookean)
                P = P - LensPotential::pressure(ratio, mu, kappa) * F.cofactor();
            else
                P = P + (kappa * (ratio - 1.0)) * Polar(F).rotation();
        }
        block.moment.set(l, pulled_back(block.moment[l], F) - block.area[l] * P);
        block.damping_moment.set(l, pulled_back(block.damping_moment[l], F));
    }
}

SOFTGRAIN_CLONES void neo_hookean_lens(MotionBlock& block) {
    stress_lanes<GrainLaw::neo_hookean, ContactLaw::lens_potential, false>(block);
}
SOFTGRAIN_CLONES void linear_lens(MotionBlock& block) {
    stress_lanes<GrainLaw::linear, ContactLaw::lens_potential, false>(block);
}
SOFTGRAIN_CLONES void neo_hookean_caps(MotionBlock& block) {
    stress_lanes<GrainLaw::neo_hookean, ContactLaw::mollon2022, false>(block);
}
SOFTGRAIN_CLONES void linear_caps(MotionBlock& block) {
    stress_lanes<GrainLaw::linear, ContactLaw::mollon2022, false>(block);
}
SOFTGRAIN_CLONES void neo_hookean_imposed(MotionBlock& block) {
    stress_lanes<GrainLaw::neo_hookean, ContactLaw::mollon2022, true>(block);
}
SOFTGRAIN_CLONES void linear_imposed(MotionBlock& block) {
    stress_lanes<GrainLaw::linear, ContactLaw::mollon2022, true>(block);
}

/// Plastic grains flow first; the elastic part of the deviator is then taken from what is left.
SOFTGRAIN_CLONES void flow_and_stress(MotionBlock& block) {
#pragma omp simd
    for (int l = 0; l < block.count; ++l) {
        const Tensor F = block.F[l];
        const double mu = block.mu[l];
        const PlasticFlow flow = return_to_yield(
            F, {block.plastic_xx[l], block.plastic_xy[l], block.plastic_yy[l]}, mu, block.yield[l]);
        block.plastic_xx[l] = flow.state.xx;
        block.plastic_xy[l] = flow.state.xy;
        block.plastic_yy[l] = flow.state.yy;
        block.plastic_work[l] = block.area[l] * flow.work;
        const Tensor P = elastic_deviator(F, flow.state, mu) - block.pressure[l] * F.cofactor();
        block.moment.set(l, pulled_back(block.moment[l], F) - block.area[l] * P);
        block.damping_moment.set(l, pulled_back(block.damping_moment[l], F));
    }
}

/// Eq. 62-64 without the spin, which those leave alone.
SOFTGRAIN_CLONES void shape_damping(MotionBlock& block) {
#pragma omp simd
    for (int l = 0; l < block.count; ++l) {
        const Tensor F = block.F[l], rate = block.F_rate[l];
        const Inertia inertia{block.inertia_x[l], block.inertia_y[l]};
        const Tensor deforming = without_spin(F, rate, inertia);
        const double dilation = DilationInertia(inertia, block.dilation_inertia[l]).momentum(F, deforming);
        const Tensor force = inertia.times(deforming) + dilation * F.cofactor();
        const Tensor damping = -block.damping_rate[l] * force;
        block.moment.set(l, block.moment[l] + damping);
        block.damping_moment.set(l, block.damping_moment[l] + damping);
    }
}

/// Eq. 58. Work at the mean of the velocities before and after equals the change of kinetic energy to
/// rounding.
template <class Motion, bool dilates>
SOFTGRAIN_INLINE void kick_lanes(MotionBlock& block, const StepTimes& times) {
    const double dt = times.kick, last = times.last_drift, next = times.next_drift;
#pragma omp simd
    for (int l = 0; l < block.count; ++l) {
        const double over_mass = dt / block.mass[l];
        const double new_vx = block.vx[l] + over_mass * block.fx[l],
                     new_vy = block.vy[l] + over_mass * block.fy[l];
        const Inertia inertia{block.inertia_x[l], block.inertia_y[l]};
        const Tensor F = block.F[l], rate = block.F_rate[l], moment = block.moment[l];
        const DilationInertia dilation(inertia, block.dilation_inertia[l]);
        Tensor free_rate = rate + dt * inertia.divides(moment);
        if constexpr (dilates) free_rate = dilation.slowed(F, rate, free_rate, inertia, last, next);
        const Tensor new_rate = Motion::allowed(F, free_rate, inertia);
        const double ux = new_vx - block.flow_vx[l], uy = new_vy - block.flow_vy[l];
        const double mean_vx = 0.5 * (block.vx[l] + new_vx) - block.flow_vx[l];
        const double mean_vy = 0.5 * (block.vy[l] + new_vy) - block.flow_vy[l];
        const Tensor mean_rate = 0.5 * (rate + new_rate);
        const double damped = -dt * (block.damping_fx[l] * mean_vx + block.damping_fy[l] * mean_vy +
                                     contraction(block.damping_moment[l], mean_rate));
        double stored =
            -dt * (block.fx[l] * mean_vx + block.fy[l] * mean_vy + contraction(moment, mean_rate));
        if constexpr (Motion::constrains)  // the constraint's reaction
            stored -= contraction(inertia.times(new_rate - free_rate), mean_rate);
        double extra = 0.0;
        if constexpr (dilates) extra = 0.5 * dilation_rate(F, new_rate) * dilation.momentum(F, new_rate);
        block.new_vx[l] = new_vx;
        block.new_vy[l] = new_vy;
        block.new_rate.set(l, new_rate);
        block.damped[l] = damped;
        block.stored[l] = stored - damped;
        block.kinetic[l] = 0.5 * block.mass[l] * (ux * ux + uy * uy) +
                           0.5 * contraction(inertia.times(new_rate), new_rate) + extra;
    }
}

/// Eq. 59.
template <class Motion>
SOFTGRAIN_INLINE void drift_lanes(MotionBlock& block, double dt) {
#pragma omp simd
    for (int l = 0; l < block.count; ++l) {
        const double dx = dt * block.new_vx[l], dy = dt * block.new_vy[l];
        block.x[l] += dx;
        block.y[l] += dy;
        block.vx[l] = block.new_vx[l];
        block.vy[l] = block.new_vy[l];
        Tensor F = block.F[l] + dt * block.new_rate[l], rate = block.new_rate[l];
        if constexpr (Motion::corrects) {
            const Inertia inertia{block.inertia_x[l], block.inertia_y[l]};
            double expected = 0.0;
            if constexpr (Motion::imposes_area) {
                // Caps at the new positions, extrapolated: the last ones would lag a step and feed energy in.
                const double caps = block.caps[l];
                expected = std::max(0.0, 2.0 * caps - block.caps_before[l]);
                block.caps_before[l] = caps;
            }
            const Tensor before = F;
            F = Motion::corrected(before, expected);
            rate = Motion::carried(before, F, rate, inertia);
            block.stored[l] -= 0.5 * (contraction(inertia.times(rate), rate) -
                                      contraction(inertia.times(block.new_rate[l]), block.new_rate[l]));
        }
        block.F.set(l, F);
        block.F_rate.set(l, rate);
        block.moved[l] = dx * dx + dy * dy;
        block.det[l] = F.det();
    }
}

SOFTGRAIN_CLONES void kick_free(MotionBlock& b, const StepTimes& times) {
    kick_lanes<Motion<Kinematics::D2F3, false>, false>(b, times);
}
SOFTGRAIN_CLONES void kick_dilating(MotionBlock& b, const StepTimes& times) {
    kick_lanes<Motion<Kinematics::D2F3, false>, true>(b, times);
}
SOFTGRAIN_CLONES void kick_imposed(MotionBlock& b, const StepTimes& times) {
    kick_lanes<Motion<Kinematics::D2F3, true>, false>(b, times);
}
SOFTGRAIN_CLONES void kick_volume(MotionBlock& b, const StepTimes& times) {
    kick_lanes<Motion<Kinematics::D2F1, false>, true>(b, times);
}
SOFTGRAIN_CLONES void kick_volume_imposed(MotionBlock& b, const StepTimes& times) {
    kick_lanes<Motion<Kinematics::D2F1, true>, false>(b, times);
}
SOFTGRAIN_CLONES void kick_rigid(MotionBlock& b, const StepTimes& times) {
    kick_lanes<Motion<Kinematics::D2F0, false>, false>(b, times);
}
SOFTGRAIN_CLONES void drift_free(MotionBlock& b, double dt) {
    drift_lanes<Motion<Kinematics::D2F3, false>>(b, dt);
}
SOFTGRAIN_CLONES void drift_imposed(MotionBlock& b, double dt) {
    drift_lanes<Motion<Kinematics::D2F3, true>>(b, dt);
}
SOFTGRAIN_CLONES void drift_volume_imposed(MotionBlock& b, double dt) {
    drift_lanes<Motion<Kinematics::D2F1, true>>(b, dt);
}
SOFTGRAIN_CLONES void drift_rigid(MotionBlock& b, double dt) {
    drift_lanes<Motion<Kinematics::D2F0, false>>(b, dt);
}

/// Largest half axis of each grain.
SOFTGRAIN_CLONES void find_reaches(MotionBlock& block) {
#pragma omp simd
    for (int l = 0; l < block.count; ++l) {
        block.reach[l] = reach_of(block.F[l], block.a[l], block.b[l]);
    }
}

}  // namespace

void add_inner_stress(MotionBlock& block, const MotionLaw& law) {
    const bool neo = law.grain_law == GrainLaw::neo_hookean;
    if (law.plastic)
        flow_and_stress(block);
    else if (law.contact_law == ContactLaw::lens_potential)
        neo ? neo_hookean_lens(block) : linear_lens(block);
    else if (law.imposes_area)
        neo ? neo_hookean_imposed(block) : linear_imposed(block);
    else
        neo ? neo_hookean_caps(block) : linear_caps(block);
    if (law.shape_damping) shape_damping(block);
}

void kick(MotionBlock& block, const MotionLaw& law, const StepTimes& times) {
    switch (law.kinematics) {
        case Kinematics::D2F0:
            return kick_rigid(block, times);
        case Kinematics::D2F1:
            return law.imposes_area ? kick_volume_imposed(block, times) : kick_volume(block, times);
        case Kinematics::D2F3:
            break;
    }
    if (law.imposes_area) return kick_imposed(block, times);
    law.dilation_inertia ? kick_dilating(block, times) : kick_free(block, times);
}

void drift(MotionBlock& block, const MotionLaw& law, double dt) {
    if (law.kinematics == Kinematics::D2F0)
        drift_rigid(block, dt);
    else if (!law.imposes_area)
        drift_free(block, dt);
    else if (law.kinematics == Kinematics::D2F1)
        drift_volume_imposed(block, dt);
    else
        drift_imposed(block, dt);
    find_reaches(block);
}

}  // namespace softgrain::sdem
