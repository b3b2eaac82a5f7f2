// What the solver shows of its grains.
#include <algorithm>
#include <cmath>

#include "bpm/outline.hpp"
#include "bpm/solver.hpp"
#include "common/at.hpp"

namespace softgrain::bpm {
namespace {

constexpr double touch_gap = 0.02;  // two grains touch below this gap [mean disc diameters]

/// x and y of each vector.
std::span<const double> components_of(const std::vector<Vec2>& vectors) {
    static_assert(sizeof(Vec2) == 2 * sizeof(double));
    return {reinterpret_cast<const double*>(vectors.data()), 2 * vectors.size()};
}

}  // namespace

GrainView BpmSolver::view(Need need) {
    view_grains();
    energy_.kinetic = kinetic_energy();
    energy_.elastic = inner_energy() - potential_at_start_;
    GrainView view;
    view.time = time_;
    view.box = box_;
    view.centroid = centroid_;
    view.velocity = velocity_;
    view.mass = grain_mass_;
    view.gravity = gravity_;
    view.reference_area = reference_area_;
    view.wall_force = wall_force_;
    view.energy = energy_;
    view.energy.external_work += work_of_gravity();
    view.contact_report = {penetration_ * diameter_, contact_result_.sweeps,
                           static_cast<double>(unconverged_steps_)};
    view.fragments = bonds_ ? count_fragments() : count_lost_discs();
    const GrainContactInput after_step{discs(),   centroid_, reference_area_, box_, touch_gap * diameter_,
                                       last_step_};
    if (box2d_ && (wants(need, Need::contacts) || wants(need, Need::stress) || wants(need, Need::parts)))
        box2d_->add_near(discs(), box_, touch_gap * diameter_);
    if (wants(need, Need::contacts) || wants(need, Need::stress)) {
        grain_contacts_ = sum_grain_contacts(solved_contacts(), after_step);
        view.contacts = grain_contacts_.contacts;
        view.stress = grain_contacts_.stress;
    }
    if (wants(need, Need::area) || wants(need, Need::outlines)) view_outlines(need, view);
    if (wants(need, Need::fields)) view_fields(view);
    if (wants(need, Need::parts)) {
        disc_contacts_ = list_disc_contacts(solved_contacts(), after_step);
        view_parts(view);
    }
    return view;
}

void BpmSolver::view_grains() {
    centroid_.assign(grains(), Vec2::Zero());
    velocity_.assign(grains(), Vec2::Zero());
    std::vector<double> mass(grains(), 0.0);
    for (std::size_t d = 0; d < x_.size(); ++d) {
        const std::size_t g = at(grain_[d]);
        centroid_[g] += mass_[d] * x_[d];
        velocity_[g] += mass_[d] * v_[d];
        mass[g] += mass_[d];
    }
    for (std::size_t g = 0; g < grains(); ++g) {
        centroid_[g] /= mass[g];
        velocity_[g] /= mass[g];
    }
}

void BpmSolver::view_outlines(Need need, GrainView& view) {
    const double rho = settings_.outline_rho * diameter_;
    std::vector<double> reach = radius_;
    for (double& r : reach) r += rho;
    NeighborList near;
    near.build(x_, reach, 1e-6 * diameter_);
    std::vector<Pair> inside;
    for (const Pair& pair : near.pairs())
        if (grain_[at(pair.i)] == grain_[at(pair.j)]) inside.push_back(pair);
    const Outline of_grains(x_, radius_, rho, inside);
    if (wants(need, Need::area)) {
        area_.resize(grains());
        for (std::size_t g = 0; g < grains(); ++g)
            area_[g] = of_grains.area(grain_start_[g], grain_start_[g + 1]);
        view.area = area_;
        view.covered_area = Outline(x_, radius_, rho, near.pairs(), &of_grains).area();
    }
    if (wants(need, Need::outlines)) {
        outline_offset_.assign(1, 0);
        outline_point_.clear();
        for (std::size_t g = 0; g < grains(); ++g) {
            of_grains.append_polygon(grain_start_[g], grain_start_[g + 1], outline_point_);
            outline_offset_.push_back(static_cast<int>(outline_point_.size()));
        }
        view.outline_offset = outline_offset_;
        view.outline_point = outline_point_;
    }
}

void BpmSolver::view_fields(GrainView& view) {
    grain_penetration_.assign(grains(), 0.0);
    const auto note = [&](int disc, double overlap) {
        double& deepest = grain_penetration_[at(grain_[at(disc)])];
        deepest = std::max(deepest, overlap / diameter_);
    };
    const ContactRows& rows = solved_contacts().rows;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::size_t i = at(rows.i[k]);
        const std::size_t j = at(rows.j[k]);
        const double overlap = radius_[i] + radius_[j] - (x_[j] - x_[i]).norm();
        note(rows.i[k], overlap);
        note(rows.j[k], overlap);
    }
    const WallRows& walls = solved_contacts().wall_rows;
    for (std::size_t k = 0; k < walls.size(); ++k) {
        const std::size_t d = at(walls.disc[k]);
        note(walls.disc[k], radius_[d] - box_.distance(walls.wall[k], x_[d]));
    }
    view.fields.push_back({"discs", "", 1, disc_count_});
    view.fields.push_back({"penetration", "disc diameters", 1, grain_penetration_});
    deformation_.resize(4 * grains());
    non_affine_motion_.resize(grains());
    for (std::size_t g = 0; g < grains(); ++g) {
        const AffineFit motion = motion_of(g);
        for (int k = 0; k < 4; ++k) deformation_[4 * g + at(k)] = motion.gradient(k / 2, k % 2);
        non_affine_motion_[g] = motion.residual / (diameter_ * diameter_);
    }
    view.fields.push_back({"internal_packing_fraction", "", 1, internal_packing_fraction_});
    view.fields.push_back({"fragments", "", 1, fragments_of_grain_});
    view.fields.push_back({"F", "1", 4, deformation_});
    view.fields.push_back({"non_affine_motion", "disc diameters^2", 1, non_affine_motion_});
}

/// Of the grain's discs since the start of the run.
AffineFit BpmSolver::motion_of(std::size_t grain) const {
    const std::size_t first = at(grain_start_[grain]);
    const std::size_t count = at(grain_start_[grain + 1]) - first;
    return fit_affine(std::span(x_start_).subspan(first, count), std::span(x_).subspan(first, count));
}

/// Grains and the discs that they have lost.
double BpmSolver::count_lost_discs() {
    fragments_of_grain_.resize(grains());
    double sum = 0.0;
    for (std::size_t g = 0; g < grains(); ++g) {
        fragments_of_grain_[g] = 1.0 + attraction_.lost_discs(g);
        sum += fragments_of_grain_[g];
    }
    return sum;
}

/// Of all grains; notes those of each grain and disc.
double BpmSolver::count_fragments() {
    const std::vector<int> label = bonds_->fragments();
    fragment_.assign(label.begin(), label.end());
    fragments_of_grain_.assign(grains(), 0.0);
    int count = 0;
    // Fragments are numbered in the order of their first disc, and grains follow each other.
    for (std::size_t d = 0; d < label.size(); ++d)
        if (label[d] == count) {
            ++count;
            ++fragments_of_grain_[at(grain_[d])];
        }
    return count;
}

void BpmSolver::view_parts(GrainView& view) {
    non_affine_displacement_.clear();
    for (std::size_t g = 0; g < grains(); ++g) {
        const AffineFit motion = motion_of(g);
        for (std::size_t d = at(grain_start_[g]); d < at(grain_start_[g + 1]); ++d) {
            const Vec2 left = motion.non_affine(x_start_[d], x_[d]);
            non_affine_displacement_.insert(non_affine_displacement_.end(), {left.x(), left.y()});
        }
    }
    view.parts.position = x_;
    view.parts.reference = x_start_;
    view.parts.radius = radius_;
    view.parts.grain = grain_;
    view.parts.contacts = disc_contacts_.contacts;
    view.parts.fields = {{"velocity", "m/s", 2, components_of(v_)},
                         {"touching", "", 1, disc_contacts_.touching},
                         {"contact_force", "N", 1, disc_contacts_.force},
                         {"non_affine_displacement", "m", 2, non_affine_displacement_}};
    if (bonds_) view.parts.fields.push_back({"fragment", "", 1, fragment_});
}

}  // namespace softgrain::bpm
