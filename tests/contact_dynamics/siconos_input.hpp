#pragma once
// A contact problem for Siconos.
#include <vector>

#include "contact_problem.hpp"
#include "siconos_fc2d.h"

namespace softgrain {

/// A problem as Siconos takes it.
class SiconosInput {
  public:
    explicit SiconosInput(const ContactProblem& problem)
        : w_(problem.delassus()), q_(problem.free_local()), friction_(problem.friction) {
        w_.makeCompressed();
    }
    SiconosProblem problem() {
        return {static_cast<int>(friction_.size()),
                w_.outerIndexPtr(),
                w_.innerIndexPtr(),
                w_.valuePtr(),
                q_.data(),
                friction_.data()};
    }

  private:
    ContactProblem::Matrix w_;
    Eigen::VectorXd q_;
    std::vector<double> friction_;
};

}  // namespace softgrain
