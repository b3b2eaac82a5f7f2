#include "mpm/grain_forces.hpp"

#include <cmath>
#include <limits>

namespace softgrain::mpm {
namespace {

Vec4 cofactor_of(const Mat2& F) {
    return {F(1, 1), -F(1, 0), -F(0, 1), F(0, 0)};
}

/// d2J/dF2.
const Mat4& second_of_determinant() {
    static const Mat4 D = (Mat4() << 0, 0, 0, 1, 0, 0, -1, 0, 0, -1, 0, 0, 1, 0, 0, 0).finished();
    return D;
}

/// Takes a stress by the undeformed grain to one by the unit disc, as vectors of 4: F = D M^-1, P : dF = (P
/// M^-T) : dD.
Mat4 pull_back(const Mat2& inverse_frame) {
    Mat4 T = Mat4::Zero();
    T.topLeftCorner<2, 2>() = inverse_frame;
    T.bottomRightCorner<2, 2>() = inverse_frame;
    return T;
}

}  // namespace

GrainForces::GrainForces(const ReferenceDisc& disc, const StiffnessPattern& pattern, bool mean_dilatation)
    : disc_(disc),
      pattern_(pattern),
      mean_dilatation_(mean_dilatation),
      F_(disc.points()),
      response_(disc.points()),
      stress_(disc.points()),
      tangent_(disc.points()),
      cell_curvature_(disc.cell.size()),
      cofactor_(disc.points()),
      slope_(disc.points(), 0.0) {}

std::span<const Mat2> GrainForces::deformation(const Grain& grain, std::span<const Vec2> q) {
    for (const Cell& c : disc_.cell) {
        const Vec2* gradient = disc_.gradient.data() + c.first_gradient;
        for (int p = 0; p < c.points; ++p) {
            double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;
            for (int a = 0; a < c.nodes; ++a, ++gradient) {
                const Vec2& x =
                    q[static_cast<std::size_t>(disc_.cell_node[static_cast<std::size_t>(c.first_node + a)])];
                xx += x.x() * gradient->x();
                xy += x.x() * gradient->y();
                yx += x.y() * gradient->x();
                yy += x.y() * gradient->y();
            }
            F_[static_cast<std::size_t>(c.first_point + p)] =
                (Mat2() << xx, xy, yx, yy).finished() * grain.inverse_frame;
        }
    }
    return F_;
}

double GrainForces::volumetric_energy(const Grain& grain) const {
    double sum = 0.0;
    for (const Cell& c : disc_.cell) {
        const auto begin = static_cast<std::size_t>(c.first_point),
                   end = begin + static_cast<std::size_t>(c.points);
        double area = 0.0, dilated = 0.0;
        for (std::size_t p = begin; p < end; ++p) {
            const double J = F_[p].determinant();
            area += disc_.weight[p];
            dilated += disc_.weight[p] * J;
            if (!mean_dilatation_) sum += disc_.weight[p] * grain.law->volumetric(J).energy;
        }
        if (mean_dilatation_) sum += area * grain.law->volumetric(dilated / area).energy;
    }
    return sum * grain.area;
}

double GrainForces::stress_out_of_plane(const Grain& grain, std::size_t point) const {
    const Mat2& F = F_[point];
    if (!grain.law->splits()) return grain.law->stress_zz(F);
    // What is left of the trace of P F^T without U(J) is the trace of a deviator in the plane.
    const Vec4& P = stress_[point];
    const double trace = P.head<2>().dot(F.row(0)) + P.tail<2>().dot(F.row(1));
    const double spherical = F.determinant() * slope_[point];
    return spherical - (trace - 2.0 * spherical);
}

double GrainForces::evaluate(const Grain& grain, std::span<const Vec2> q, std::span<const PlasticState> state,
                             std::span<Vec2> force, std::span<Mat2> stiffness) {
    deformation(grain, q);
    const bool splits = grain.law->splits(), with_stiffness = !stiffness.empty();
    if (splits)
        for (const Mat2& F : F_)
            if (!(F.determinant() > 0.0)) return std::numeric_limits<double>::infinity();
    grain.law->respond(F_, state, with_stiffness, response_);
    if (with_stiffness) std::fill(stiffness.begin(), stiffness.end(), Mat2::Zero());

    const Mat4 T = pull_back(grain.inverse_frame);
    double energy = 0.0;
    for (std::size_t k = 0; k < disc_.cell.size(); ++k) {
        const Cell& c = disc_.cell[k];
        const auto begin = static_cast<std::size_t>(c.first_point),
                   end = begin + static_cast<std::size_t>(c.points);
        Volumetric mean;
        double area = 0.0;
        if (splits && mean_dilatation_) {
            double J = 0.0;
            for (std::size_t p = begin; p < end; ++p) {
                J += disc_.weight[p] * F_[p].determinant();
                area += disc_.weight[p];
            }
            mean = grain.law->volumetric(J / area);
            energy += area * mean.energy;
        }
        cell_curvature_[k] = area > 0.0 ? mean.curvature / area : 0.0;
        for (std::size_t p = begin; p < end; ++p) {
            const double w = disc_.weight[p];
            Response& r = response_[p];
            energy += w * r.energy;
            if (splits) {
                cofactor_[p] = cofactor_of(F_[p]);
                Volumetric v = mean;
                if (!mean_dilatation_) {
                    v = grain.law->volumetric(F_[p].determinant());
                    energy += w * v.energy;
                    if (with_stiffness) r.tangent += v.curvature * cofactor_[p] * cofactor_[p].transpose();
                }
                slope_[p] = v.slope;
                r.stress += v.slope * cofactor_[p];
                if (with_stiffness) r.tangent += v.slope * second_of_determinant();
            }
            stress_[p] = r.stress;
            const Vec4 pulled = w * grain.area * (T * r.stress);
            const Vec2* gradient =
                disc_.gradient.data() + c.first_gradient + (p - begin) * static_cast<std::size_t>(c.nodes);
            for (int a = 0; a < c.nodes; ++a) {
                Vec2& f = force[static_cast<std::size_t>(
                    disc_.cell_node[static_cast<std::size_t>(c.first_node + a)])];
                f.x() += pulled[0] * gradient[a].x() + pulled[1] * gradient[a].y();
                f.y() += pulled[2] * gradient[a].x() + pulled[3] * gradient[a].y();
            }
            if (with_stiffness) tangent_[p].noalias() = (w * grain.area) * (T * r.tangent * T.transpose());
        }
        if (with_stiffness) add_cell_stiffness(c, k, grain, stiffness);
    }
    return energy * grain.area;
}

/// G^T A G for each pair of components, G the gradients at all points of the cell.
void GrainForces::add_cell_stiffness(const Cell& c, std::size_t number, const Grain& grain,
                                     std::span<Mat2> stiffness) {
    const int points = c.points, nodes = c.nodes;
    gradient_.resize(2 * points, nodes);
    image_.resize(2 * points, nodes);
    const Vec2* gradient = disc_.gradient.data() + c.first_gradient;
    for (int p = 0; p < points; ++p)
        for (int a = 0; a < nodes; ++a, ++gradient) {
            gradient_(2 * p, a) = gradient->x();
            gradient_(2 * p + 1, a) = gradient->y();
        }
    constexpr int row_of[3] = {0, 2, 2}, column_of[3] = {0, 0, 2};  // xx, yx, yy
    for (int b = 0; b < 3; ++b) {
        for (int p = 0; p < points; ++p)
            image_.middleRows<2>(2 * p).noalias() =
                tangent_[static_cast<std::size_t>(c.first_point + p)].block<2, 2>(row_of[b], column_of[b]) *
                gradient_.middleRows<2>(2 * p);
        block_[b].noalias() = gradient_.transpose() * image_;
    }
    if (cell_curvature_[number] != 0.0) {
        const Mat4 T = pull_back(grain.inverse_frame);
        dilatation_.setZero(2 * nodes);
        gradient = disc_.gradient.data() + c.first_gradient;
        for (int p = 0; p < points; ++p) {
            const auto at = static_cast<std::size_t>(c.first_point + p);
            const Vec4 pulled = disc_.weight[at] * (T * cofactor_[at]);
            for (int a = 0; a < nodes; ++a, ++gradient) {
                dilatation_[2 * a] += pulled[0] * gradient->x() + pulled[1] * gradient->y();
                dilatation_[2 * a + 1] += pulled[2] * gradient->x() + pulled[3] * gradient->y();
            }
        }
    }
    const double curvature = cell_curvature_[number] * grain.area;
    const int* place = pattern_.place.data() + pattern_.cell_start[number];
    for (int a = 0; a < nodes; ++a)
        for (int b = 0; b <= a; ++b, ++place) {
            Mat2& K = stiffness[static_cast<std::size_t>(*place)];
            K(0, 0) += block_[0](a, b);
            K(1, 0) += block_[1](a, b);
            K(0, 1) += block_[1](b, a);
            K(1, 1) += block_[2](a, b);
            if (curvature != 0.0)
                K.noalias() +=
                    curvature * dilatation_.segment<2>(2 * a) * dilatation_.segment<2>(2 * b).transpose();
        }
}

}  // namespace softgrain::mpm
