#include "rigid_dem/pair_kernel.hpp"

#include <stdexcept>

#include "rigid_dem/laws/contact.hpp"

namespace softgrain::rigid_dem {
namespace {

/// Four numbers of a grain, or of a pair, that travel together.
struct alignas(32) Four {
    double c[4];
};

struct Batch {
    int count;
    alignas(64) Four apart[lanes];       ///< j - i of x, y, vx, vy
    alignas(64) Four together[lanes];    ///< j + i of spin, radius, rim_speed, inverse_mass
    alignas(64) Four difference[lanes];  ///< i - j of the same, for laws that want it
    alignas(64) Four force[lanes];       ///< fx, fy, shear, shear overlap / 2
    alignas(64) double fx[lanes], fy[lanes], shear[lanes], lost_torque[lanes], moment[lanes];
};

template <bool with_differences>
SOFTGRAIN_INLINE void gather(const PairBlock& block, int first, Batch& batch) {
    const LocalPair* const pair = block.pair + first;
    for (int l = 0; l < batch.count; ++l) {
        const double* const a = &block.grain[pair[l].i].x;
        const double* const b = &block.grain[pair[l].j].x;
        for (int c = 0; c < 4; ++c) batch.apart[l].c[c] = b[c] - a[c];
        for (int c = 0; c < 4; ++c) batch.together[l].c[c] = b[c + 4] + a[c + 4];
        if constexpr (with_differences)
            for (int c = 0; c < 4; ++c) batch.difference[l].c[c] = a[c + 4] - b[c + 4];
    }
    for (int l = batch.count; l < lanes; ++l) {  // nothing at a distance
        batch.apart[l] = {1.0, 0.0, 0.0, 0.0};
        batch.together[l] = {0.0, 0.0, 0.0, 1.0};
        if constexpr (with_differences) batch.difference[l] = {};
    }
}

template <class Normal, unsigned features, bool with_virial>
SOFTGRAIN_INLINE void answer(const PairBlock& block, int first, Batch& batch, const LawConstants& law,
                             double dt) {
    constexpr bool damping = features & has_damping, friction = features & has_friction,
                   rolling = features & has_rolling, adhesion = features & has_adhesion,
                   grips = friction && !Normal::constant_stiffness;
    const int at = block.uniform ? 0 : first;
    const double *const k = block.k + at, *const shear_ratio = block.shear_ratio + at,
                        *const shear_compliance = block.shear_compliance + at;
    double *const shear = block.memory.shear + (friction ? first : 0),
                  *const dashpot = block.memory.dashpot + (damping ? first : 0),
                  *const grip = block.memory.grip + (grips ? first : 0),
                  *const held = block.memory.moment + (rolling ? first : 0),
                  *const bond = block.memory.bond + (adhesion ? first : 0);
    PairSums& sums = *block.sums;
#pragma omp simd
    for (int l = 0; l < lanes; ++l) {
        const double dx = batch.apart[l].c[0], dy = batch.apart[l].c[1];
        const double dvx = batch.apart[l].c[2], dvy = batch.apart[l].c[3];
        const double spins = batch.together[l].c[0], reach = batch.together[l].c[1];
        const double rim_speed = batch.together[l].c[2];
        const double distance = std::sqrt(dx * dx + dy * dy), per_distance = 1.0 / distance;
        const double nx = dx * per_distance, ny = dy * per_distance;
        const double overlap = reach - distance;

        ContactInput in{};
        in.overlap = overlap;
        in.closing = -(dvx * nx + dvy * ny);
        in.slip = dvy * nx - dvx * ny - rim_speed + 0.5 * overlap * spins;
        in.k = k[l];
        in.shear_ratio = shear_ratio[l];
        in.shear_compliance = shear_compliance[l];
        in.inverse_mass = batch.together[l].c[3];
        if constexpr (rolling || adhesion) {
            const double unlike = batch.difference[l].c[1];
            in.spin_difference = batch.difference[l].c[0];
            in.rolling_radius = 0.25 * (reach - unlike * unlike / reach);
            in.adhesive_length = reach - std::abs(unlike);
        }
        ContactMemory memory;
        if constexpr (friction) memory.shear = shear[l];
        if constexpr (damping) memory.dashpot = dashpot[l];
        if constexpr (grips) memory.grip = grip[l];
        if constexpr (rolling) memory.moment = held[l];
        if constexpr (adhesion) memory.bond = bond[l];

        const ContactForce force = contact_force<Normal, features>(in, memory, law, dt);

        if constexpr (friction) shear[l] = memory.shear;
        if constexpr (damping) dashpot[l] = memory.dashpot;
        if constexpr (grips) grip[l] = memory.grip;
        if constexpr (rolling) held[l] = memory.moment;
        if constexpr (adhesion) bond[l] = memory.bond;
        const double fx = -force.normal * nx - force.shear * ny, fy = -force.normal * ny + force.shear * nx;
        batch.fx[l] = fx;
        batch.fy[l] = fy;
        batch.shear[l] = force.shear;
        batch.lost_torque[l] = 0.5 * force.shear * overlap;
        if constexpr (rolling) batch.moment[l] = force.moment;
        if constexpr (with_virial) {
            sums.virial_xx[l] += fx * dx;
            sums.virial_xy[l] += fx * dy;
            sums.virial_yx[l] += fy * dx;
            sums.virial_yy[l] += fy * dy;
        }
        if constexpr (friction) sums.friction_loss[l] += force.friction_loss;
        if constexpr (damping) sums.damping_loss[l] += force.damping_loss;
        if constexpr (adhesion) sums.adhesion_loss[l] += force.adhesion_loss;
        sums.overlap[l] = overlap > sums.overlap[l] ? overlap : sums.overlap[l];
    }
}

SOFTGRAIN_INLINE void interleave(Batch& batch) {
#pragma omp simd
    for (int l = 0; l < lanes; ++l) {
        batch.force[l].c[0] = batch.fx[l];
        batch.force[l].c[1] = batch.fy[l];
        batch.force[l].c[2] = batch.shear[l];
        batch.force[l].c[3] = batch.lost_torque[l];
    }
}

template <bool rotates, bool with_moments>
SOFTGRAIN_INLINE void scatter(const PairBlock& block, int first, const Batch& batch) {
    constexpr int components = rotates ? 4 : 2;
    const LocalPair* const pair = block.pair + first;
    for (int l = 0; l < batch.count; ++l) {
        double* const a = &block.force[pair[l].i].fx;
        double* const b = &block.force[pair[l].j].fx;
        constexpr double on_j[4]{-1.0, -1.0, 1.0, 1.0};
        for (int c = 0; c < components; ++c) a[c] += batch.force[l].c[c];
        for (int c = 0; c < components; ++c) b[c] += on_j[c] * batch.force[l].c[c];
        if constexpr (with_moments) {
            a[3] -= batch.moment[l];
            b[3] += batch.moment[l];
        }
    }
}

template <class Normal, unsigned features, bool with_virial>
SOFTGRAIN_INLINE void each_batch(const PairBlock& block, const LawConstants& law, double dt) {
    Batch batch;
    for (int first = 0; first < block.pairs; first += lanes) {
        batch.count = block.pairs - first < lanes ? block.pairs - first : lanes;
        gather<(features & (has_rolling | has_adhesion)) != 0>(block, first, batch);
        answer<Normal, features, with_virial>(block, first, batch, law, dt);
        interleave(batch);
        scatter<(features & has_friction) != 0, (features & has_rolling) != 0>(block, first, batch);
    }
}

#define SOFTGRAIN_PAIR_KERNEL(name, Normal, features)                                                 \
    SOFTGRAIN_CLONES void name(const PairBlock& block, const LawConstants& law, double dt) {          \
        each_batch<Normal, features, false>(block, law, dt);                                          \
    }                                                                                                 \
    SOFTGRAIN_CLONES void name##_virial(const PairBlock& block, const LawConstants& law, double dt) { \
        each_batch<Normal, features, true>(block, law, dt);                                           \
    }

constexpr unsigned rolling = has_friction | has_rolling, adhesion = has_friction | has_adhesion;
SOFTGRAIN_PAIR_KERNEL(linear, Linear, no_part)
SOFTGRAIN_PAIR_KERNEL(linear_damping, Linear, has_damping)
SOFTGRAIN_PAIR_KERNEL(linear_friction, Linear, has_friction)
SOFTGRAIN_PAIR_KERNEL(linear_friction_damping, Linear, has_friction | has_damping)
SOFTGRAIN_PAIR_KERNEL(linear_rolling, Linear, rolling)
SOFTGRAIN_PAIR_KERNEL(linear_rolling_damping, Linear, rolling | has_damping)
SOFTGRAIN_PAIR_KERNEL(linear_adhesion, Linear, adhesion)
SOFTGRAIN_PAIR_KERNEL(linear_adhesion_damping, Linear, adhesion | has_damping)
SOFTGRAIN_PAIR_KERNEL(linear_adhesion_rolling, Linear, adhesion | rolling)
SOFTGRAIN_PAIR_KERNEL(linear_adhesion_rolling_damping, Linear, adhesion | rolling | has_damping)
SOFTGRAIN_PAIR_KERNEL(hertz, Hertz, no_part)
SOFTGRAIN_PAIR_KERNEL(hertz_damping, Hertz, has_damping)
SOFTGRAIN_PAIR_KERNEL(hertz_friction, Hertz, has_friction)
SOFTGRAIN_PAIR_KERNEL(hertz_friction_damping, Hertz, has_friction | has_damping)
SOFTGRAIN_PAIR_KERNEL(hertz_rolling, Hertz, rolling)
SOFTGRAIN_PAIR_KERNEL(hertz_rolling_damping, Hertz, rolling | has_damping)
#undef SOFTGRAIN_PAIR_KERNEL

struct Row {
    bool hertz;
    unsigned features;
    PairKernel kernel, with_virial;
};

constexpr Row table[]{
    {false, no_part, linear, linear_virial},
    {false, has_damping, linear_damping, linear_damping_virial},
    {false, has_friction, linear_friction, linear_friction_virial},
    {false, has_friction | has_damping, linear_friction_damping, linear_friction_damping_virial},
    {false, rolling, linear_rolling, linear_rolling_virial},
    {false, rolling | has_damping, linear_rolling_damping, linear_rolling_damping_virial},
    {false, adhesion, linear_adhesion, linear_adhesion_virial},
    {false, adhesion | has_damping, linear_adhesion_damping, linear_adhesion_damping_virial},
    {false, adhesion | rolling, linear_adhesion_rolling, linear_adhesion_rolling_virial},
    {false, adhesion | rolling | has_damping, linear_adhesion_rolling_damping,
     linear_adhesion_rolling_damping_virial},
    {true, no_part, hertz, hertz_virial},
    {true, has_damping, hertz_damping, hertz_damping_virial},
    {true, has_friction, hertz_friction, hertz_friction_virial},
    {true, has_friction | has_damping, hertz_friction_damping, hertz_friction_damping_virial},
    {true, rolling, hertz_rolling, hertz_rolling_virial},
    {true, rolling | has_damping, hertz_rolling_damping, hertz_rolling_damping_virial},
};

}  // namespace

PairKernel pair_kernel(bool hertz_law, unsigned features, bool with_virial) {
    for (const Row& row : table)
        if (row.hertz == hertz_law && row.features == features)
            return with_virial ? row.with_virial : row.kernel;
    throw std::logic_error("no kernel for this combination of contact laws");
}

}  // namespace softgrain::rigid_dem
