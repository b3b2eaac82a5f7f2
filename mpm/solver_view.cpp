// What the solver shows of its grains.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mpm/contact/grain_contacts.hpp"
#include "mpm/disc/quadratic_spline.hpp"
#include "mpm/solver.hpp"

namespace softgrain::mpm {
namespace {

/// Area inside a closed quadratic B-spline curve: half of the integral of c x dc, two Gauss points a span.
double area_inside(std::span<const Vec2> control) {
    const std::size_t n = control.size();
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 &a = control[k], &b = control[(k + 1) % n], &c = control[(k + 2) % n];
        for (const double t : {0.5 - 0.5 / std::numbers::sqrt3, 0.5 + 0.5 / std::numbers::sqrt3}) {
            const SplineSpan s = spline_span(t);
            sum += 0.25 * cross(s.value[0] * a + s.value[1] * b + s.value[2] * c,
                                s.slope[0] * a + s.slope[1] * b + s.slope[2] * c);
        }
    }
    return sum;
}

}  // namespace

GrainView MpmSolver::view(Need need) {
    evaluate();
    GrainView view;
    view.time = time_;
    view.box = box_;
    view.centroid = centroid_;
    view.velocity = velocity_;
    view.mass = mass_;
    view.gravity = settings_.equilibrium.gravity;
    view.reference_area = reference_area_;
    view.wall_force = wall_force_;
    view.energy = energy_;
    if (!motion_) view.energy.external_work += work_of_gravity();
    view.contact_report.penetration = deepest_overlap(contacts());
    const CommonGrid* const grid = motion_ ? motion_->common_grid() : nullptr;
    view.contact_report.sweeps = grid ? grid->sweeps() : iterations_of_step_;
    view.contact_report.unconverged_steps = grid ? grid->unconverged_steps() : 0.0;
    if (wants(need, Need::area) || wants(need, Need::stress)) {
        area_.resize(grains_.size());
        for (std::size_t g = 0; g < grains_.size(); ++g)
            area_[g] = area_inside(surfaces().controls_of(grains_, g));
        view.area = area_;
        view.covered_area = covered_area();
    }
    if (wants(need, Need::contacts)) {
        contact_ = grid ? grid->grain_contacts()
                        : sum_grain_contacts(grains_, surfaces(), contacts(), friction().sliders());
        view.contacts = contact_;
    }
    if (wants(need, Need::stress)) {
        view_stress();
        view.stress = stress_;
    }
    if (wants(need, Need::outlines)) {
        view_outlines();
        view.outline_offset = outline_offset_;
        view.outline_point = outline_point_;
    }
    if (wants(need, Need::fields) && equilibrium_) {
        residual_of_grain_.assign(grains_.size(), 0.0);
        for (std::size_t k = 0; k < force_.size(); ++k) {
            double& largest = residual_of_grain_[k / grains_.nodes()];
            largest = std::max(largest, force_[k].norm());
        }
        view.fields.push_back({"unbalanced_nodal_force", "N", 1, residual_of_grain_});
    }
    if (wants(need, Need::parts)) view_parts(view);
    return view;
}

double MpmSolver::work_of_gravity() const {
    double work = 0.0;
    for (std::size_t g = 0; g < grains_.size(); ++g)
        work += mass_[g] * settings_.equilibrium.gravity.dot(centroid_[g] - placed_[g]);
    return work;
}

/// What overlaps, or lies outside of the walls, is left out once.
double MpmSolver::covered_area() const {
    double sum = 0.0;
    for (const double a : area_) sum += a;
    return sum - overlap_area(surfaces(), contacts(), grains_);
}

/// (1/a) integral of P F^T over the undeformed grain, compression positive.
void MpmSolver::view_stress() {
    stress_.assign(grains_.size(), Mat2::Zero());
    std::vector<Vec2> unused(grains_.nodes(), Vec2::Zero());
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        const Grain& grain = grains_.grain[g];
        forces_->evaluate(grain, grains_.of(q_, g), grains_.of_points(plastic(), g), unused, {});
        for (std::size_t p = 0; p < grains_.points(); ++p) {
            const Vec4& P = forces_->stress()[p];
            const Mat2 stress = (Mat2() << P[0], P[1], P[2], P[3]).finished();
            stress_[g] -= grains_.disc->weight[p] * grain.area / area_[g] * stress *
                          forces_->deformation()[p].transpose();
        }
    }
}

/// Through the joints of the surface curve, which lie on it.
void MpmSolver::view_outlines() {
    outline_offset_.assign(1, 0);
    outline_point_.clear();
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        const auto control = surfaces().controls_of(grains_, g);
        for (std::size_t k = 0; k < control.size(); ++k)
            outline_point_.emplace_back(0.5 * (control[k] + control[(k + 1) % control.size()]));
        outline_offset_.push_back(static_cast<int>(outline_point_.size()));
    }
}

void MpmSolver::view_parts(GrainView& view) {
    const std::size_t points = grains_.points(), all = grains_.size() * points;
    part_position_.resize(all);
    von_mises_.resize(all);
    pressure_.resize(all);
    part_deformation_.resize(4 * all);
    plastic_strain_.resize(all);
    std::vector<Vec2> unused(grains_.nodes(), Vec2::Zero());
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        const Grain& grain = grains_.grain[g];
        forces_->evaluate(grain, grains_.of(q_, g), grains_.of_points(plastic(), g), unused, {});
        for (std::size_t p = 0; p < points; ++p) {
            const std::size_t k = g * points + p;
            part_position_[k] = grains_.disc->at_points.at(p, grains_.of(q_, g));
            const Mat2& F = forces_->deformation()[p];
            const Vec4& P = forces_->stress()[p];
            const double J = F.determinant();
            const Mat2 cauchy = (Mat2() << P[0], P[1], P[2], P[3]).finished() * F.transpose() / J;
            const double zz = forces_->stress_out_of_plane(grain, p) / J;
            const double mean = (cauchy.trace() + zz) / 3.0;
            pressure_[k] = -mean;
            von_mises_[k] = std::sqrt(
                1.5 * ((cauchy - mean * Mat2::Identity()).squaredNorm() + (zz - mean) * (zz - mean)));
            for (int c = 0; c < 4; ++c)
                part_deformation_[4 * k + static_cast<std::size_t>(c)] = F(c / 2, c % 2);
            if (!plastic().empty()) plastic_strain_[k] = plastic()[k].equivalent;
        }
    }
    view.parts.position = part_position_;
    view.parts.reference = part_reference_;
    view.parts.radius = part_radius_;
    view.parts.grain = part_grain_;
    view.parts.fields = {{"von_mises_stress", "N/m", 1, von_mises_},
                         {"pressure", "N/m", 1, pressure_},
                         {"F", "1", 4, part_deformation_}};
    if (!plastic().empty()) view.parts.fields.push_back({"plastic_strain", "1", 1, plastic_strain_});
}

/// Of grains that remember: without what flow has dissipated.
double MpmSolver::stored_energy() {
    double sum = contacts().energy();
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        const Grain& grain = grains_.grain[g];
        const auto F = forces_->deformation(grain, grains_.of(q_, g));
        const auto state = grains_.of_points(plastic(), g);
        sum += forces_->volumetric_energy(grain);
        for (std::size_t p = 0; p < F.size(); ++p)
            sum += grains_.disc->weight[p] * grain.area * grain.law->stored(F[p], state[p]);
    }
    return sum;
}

double MpmSolver::dissipated_by_flow() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < plastic().size(); ++k)
        sum += grains_.disc->weight[k % grains_.points()] * grains_.grain[k / grains_.points()].area *
               plastic()[k].dissipated;
    return sum;
}

}  // namespace softgrain::mpm
