#include "common/observables/fabric.hpp"

#include <cmath>

namespace softgrain {

Fabric fabric_of(const Mat2& tensor) {
    const double difference = tensor(0, 0) - tensor(1, 1), shear = tensor(0, 1) + tensor(1, 0);
    return {tensor, 2.0 * std::hypot(difference, shear), 0.5 * std::atan2(shear, difference)};
}

Fabric fabric(const GrainView& view) {
    Mat2 sum = Mat2::Zero();
    double contacts = 0.0;
    for (const GrainContact& c : view.contacts) {
        if (view.at_boundary(c)) continue;
        sum += c.normal * c.normal.transpose();
        contacts += 1.0;
    }
    return fabric_of(contacts > 0.0 ? Mat2(sum / contacts) : sum);
}

}  // namespace softgrain
