#pragma once
// The way to the minimum of the contact model, which is quadratic only as long as points touch as they do.
#include <span>
#include <vector>

#include "mpm/contact/contact_model.hpp"

namespace softgrain::mpm {

/// Newton's method on the piecewise quadratic model with exact search along each of its steps: what a
/// solution for given touches leads to is approached as far as the energy of the model falls.
class ModelSearch {
  public:
    explicit ModelSearch(const ContactModel& model) : model_(model) {}

    /// d [all nodes] is where the model has its minimum if points touch as in `as`. The share of the way to
    /// it, from where the last call ended, that has the least energy; 1 in the first call.
    double approach(std::span<const Vec2> d, std::span<const Touch> as);
    /// Where it ended.
    std::span<const Vec2> moved() const { return moved_; }
    /// As points touch there.
    std::vector<Touch> touches() const;

  private:
    double slope(double share) const;

    const ContactModel& model_;
    std::vector<Vec2> moved_, force_;         ///< [points] where it is; force that balances all but contacts
    std::vector<Vec2> onward_, force_there_;  ///< the same of d
};

}  // namespace softgrain::mpm
