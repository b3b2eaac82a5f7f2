#pragma once
// Return of an elastic strain to the yield surface, in principal axes: two in the plane, the third out of it.
// No axis of the plane is special, and stretches may be equal: see stress_over_strain().
#include <array>

namespace softgrain::mpm {

/// Deviator of principal values a: u = (a1 - a2)/sqrt(2), v = (a1 + a2 - 2 a3)/sqrt(6). Its norm is that of
/// the tensor.
struct Deviator {
    double u, v;

    double norm() const;
    std::array<double, 3> values() const;  ///< principal
};

/// Left Cauchy-Green tensor of determinant 1, by its principal values.
class IsochoricStrain {
  public:
    /// From half the difference of the values in the plane, >= 0, and the value out of it.
    IsochoricStrain(double half_difference, double zz);

    double half_difference() const { return half_difference_; }
    double mean() const { return mean_; }                      ///< of the values in the plane
    double first() const { return mean_ + half_difference_; }  ///< the larger value in the plane
    double second() const { return 1.0 / (first() * zz_); }    ///< the smaller one
    double zz() const { return zz_; }                          ///< out of the plane
    double trace() const { return 2.0 * mean_ + zz_; }
    Deviator deviator() const;
    Deviator logarithmic() const;  ///< of the strains log(value)/2

  private:
    double half_difference_, zz_, mean_;
};

/// A step in which plastic flow d, a change of logarithmic strain, takes the elastic strain from e to e - d.
/// The end lies on the yield surface and the flow is along the stress there:
///     dev exp(2 (e - d)) = radius n,   d = flow n,   |n| = 1
/// the minimum over d of tr exp(2 (e - d))/2 + radius |d| (Ortiz and Stainier 1999, Comput. Methods Appl.
/// Mech. Eng. 171, 419).
struct YieldReturn {
    IsochoricStrain end;
    Deviator normal;   ///< n
    double flow;       ///< |d|
    double stiffness;  ///< a of d(radius n)/de = a p x p, with p the unit vector across n
};

/// To the surface |dev| = radius from a strain beyond it. The end lies on the surface, and flow along its
/// normal, to the rounding of the strains.
YieldReturn return_to_yield(const IsochoricStrain& trial, double radius);

/// (s1 - s2)/(b1 - b2) for the stress s = dev exp(2 (e - d)) of a step and the values b of its trial strain;
/// without a difference of nearly equal numbers, and with its limit where b1 = b2.
double stress_over_strain(const IsochoricStrain& trial, const YieldReturn& step, double radius);

}  // namespace softgrain::mpm
