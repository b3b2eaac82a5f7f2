#pragma once
// The fastest vibration of grains as they are deformed, which limits explicit time steps.
#include <span>
#include <vector>

#include "common/checkpoint.hpp"
#include "mpm/dynamics/mass.hpp"
#include "mpm/grain_forces.hpp"
#include "mpm/grains.hpp"

namespace softgrain::mpm {

/// Largest eigenvalue of M^-1 (K + C) of each grain: K its own tangent, C a bound of what contacts add, by
/// power iteration. C is as if all surface points of the grain touched, in all directions. Where grains meet
/// (dp - dc)^2 <= 2 dp^2 + 2 dc^2 parts a contact between both; each grain then has twice the contact
/// stiffness on its own surface, and two alike that move against each other reach it.
class FastestMode {
  public:
    /// penalty: contact stiffness as in Contacts; 0 if contacts have none. Tangents are of the mean
    /// dilatation if told so.
    FastestMode(const Grains& grains, const Mass& mass, double penalty, bool mean_dilatation);

    /// Of all grains. q [all nodes], plastic [all points] or empty.
    void find(std::span<const Vec2> q, std::span<const PlasticState> plastic);
    /// Marks grain g if a component of its deformation gradient F [points] has changed by more than `change`
    /// since its mode was found. Safe to call for several grains at once.
    void look_at(std::size_t g, std::span<const Mat2> F);
    /// Of marked grains.
    void refresh(std::span<const Vec2> q, std::span<const PlasticState> plastic);

    void save(Checkpoint& to) const;
    /// Throws InputError if there were other grains.
    void load(const Checkpoint& from);

    /// Of all grains: the square of the largest angular frequency [1/s^2].
    double squared_frequency() const { return largest_; }
    /// Modes that have been looked for, of single grains.
    long long found() const { return found_; }

    static constexpr double change = 0.1;

  private:
    void find_marked(std::span<const Vec2> q, std::span<const PlasticState> plastic);
    void find_mode(std::size_t g, GrainForces& forces, std::span<const Vec2> q,
                   std::span<const PlasticState> plastic, std::vector<Mat2>& stiffness);
    /// y = (K + C) x.
    void apply(std::size_t g, std::span<const Mat2> stiffness, std::span<const Vec2> x,
               std::span<Vec2> y) const;
    /// Of one cell of grain g.
    Mat2& deformation(std::size_t g, std::size_t cell) {
        return deformation_[g * grains_.disc->cell.size() + cell];
    }

    const Grains& grains_;
    const Mass& mass_;
    std::vector<GrainForces> forces_;  ///< one a thread
    std::vector<double> contact_;      ///< [grains] of C, per length of the unit circle [N/m]
    std::vector<double> squared_;      ///< [grains] [1/s^2]
    std::vector<Vec2> mode_;           ///< [all nodes]
    std::vector<Mat2> deformation_;    ///< [grains * cells] at the first point of each cell
    std::vector<char> marked_;
    double largest_ = 0.0;
    long long found_ = 0;
};

}  // namespace softgrain::mpm
