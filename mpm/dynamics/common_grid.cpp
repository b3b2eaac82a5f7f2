#include "mpm/dynamics/common_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "common/at.hpp"

namespace softgrain::mpm {
namespace {

/// Mass at a node that counts [density * cell].
constexpr double least_mass = 1e-6;

/// The four nodes around a point, with S and its gradient times the spacing.
struct Corners {
    int x, y;  ///< of the first
    std::array<double, 4> value;
    std::array<Vec2, 4> slope;

    Corners(const Vec2& point, double spacing) {
        const Vec2 in_cells = point / spacing;
        x = static_cast<int>(std::floor(in_cells.x()));
        y = static_cast<int>(std::floor(in_cells.y()));
        const double s = in_cells.x() - x, t = in_cells.y() - y;
        value = {(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t};
        slope = {Vec2{t - 1.0, s - 1.0}, Vec2{1.0 - t, -s}, Vec2{-t, 1.0 - s}, Vec2{t, s}};
    }
};

}  // namespace

CommonGrid::CommonGrid(const Grains& grains, const Mass& mass, const CommonGridSettings& settings)
    : grains_(grains), mass_(mass), settings_(settings), window_(grains.size()) {
    double radius = 0.0;
    for (const Grain& grain : grains.grain) radius += grain.radius;
    spacing_ = grains.disc->spacing() * radius / static_cast<double>(grains.size());
    wall_velocity_.fill(Vec2::Zero());
    wall_force_.fill(Vec2::Zero());
}

void CommonGrid::collide(std::span<const Vec2> q, std::span<const Vec2> last, std::span<Vec2> v,
                         const Box& box, const std::array<Vec2, 4>& wall_velocity, double dt) {
    const std::size_t nodes = grains_.nodes();
    wall_velocity_ = wall_velocity;
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grains_.size(); ++g) fill(g, q.subspan(g * nodes, nodes));
    const std::vector<NodeContact> before = std::exchange(contact_, {});
    find_contacts(box);
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grains_.size(); ++g) find_rows(g);
    find_velocities(last);
    for (NodeContact& c : contact_) c.approach = relative_velocity(c);
    remember(before, dt_ > 0.0 ? dt / dt_ : 0.0);
    dt_ = dt;
    apply(v);
    momentum_ = 1.0;
    sweeps_ = 0;
    bool converged = contact_.empty();
    while (!converged && sweeps_ < settings_.most_sweeps) {
        find_velocities(v);
        converged = sweep();
        if (converged || ++sweeps_ == settings_.most_sweeps) break;
        look_ahead();
        apply(v);
    }
    if (!converged) ++unconverged_steps_;
    apply(v);
    find_velocities(v);
    take_stock(dt);
}

void CommonGrid::fill(std::size_t g, std::span<const Vec2> q) {
    const ReferenceDisc& disc = *grains_.disc;
    Window& window = window_[g];
    window.point.resize(disc.points());
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t p = 0; p < disc.points(); ++p) {
        const Vec2 x = disc.at_points.at(p, q);
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
        window.point[p] = x;
    }
    const Corners first(low, spacing_), last(high, spacing_);
    window.x0 = first.x;
    window.y0 = first.y;
    window.nx = last.x + 2 - first.x;
    window.ny = last.y + 2 - first.y;
    const std::size_t nodes = at(window.nx) * at(window.ny);
    window.mass.assign(nodes, 0.0);
    window.gradient.assign(nodes, Vec2::Zero());
    window.row.assign(nodes, -1);
    window.share.clear();
    const double density = grains_.grain[g].density * grains_.grain[g].area;
    for (std::size_t p = 0; p < disc.points(); ++p) {
        const Corners corners(window.point[p], spacing_);
        const double mass = density * disc.weight[p];
        const std::size_t node = at((corners.y - window.y0) * window.nx + corners.x - window.x0);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t n = node + k % 2 + (k / 2) * at(window.nx);
            window.mass[n] += mass * corners.value[k];
            // By the place of the node, against that by the place of the point.
            window.gradient[n] -= mass / spacing_ * corners.slope[k];
        }
    }
    for (double& m : window.mass)
        if (m < least_mass * grains_.grain[g].density * spacing_ * spacing_) m = 0.0;
}

void CommonGrid::find_contacts(const Box& box) {
    node_mass_.clear();
    for (std::size_t g = 0; g < window_.size(); ++g) {
        const Window& w = window_[g];
        for (int y = 0; y < w.ny; ++y)
            for (int x = 0; x < w.nx; ++x)
                if (w.mass[at(y * w.nx + x)] > 0.0)
                    node_mass_.push_back({w.y0 + y, w.x0 + x, static_cast<int>(g)});
    }
    std::ranges::sort(node_mass_);
    share_.clear();
    for (auto first = node_mass_.begin(); first != node_mass_.end();) {
        const auto end = std::find_if(first, node_mass_.end(), [&](const NodeMass& other) {
            return other.y != first->y || other.x != first->x;
        });
        add_contacts({first, end}, box);
        first = end;
    }
}

void CommonGrid::add_contacts(std::span<const NodeMass> grains, const Box& box) {
    const int x = grains[0].x, y = grains[0].y;
    const Vec2 place = spacing_ * Vec2(x, y);
    std::array<bool, 4> wall{};
    for (int w = 0; w < 4 && !box.periodic; ++w) wall[at(w)] = box.distance(w, place) < spacing_;
    if (grains.size() < 2 && std::ranges::find(wall, true) == wall.end()) return;
    const int first = static_cast<int>(share_.size());
    for (const NodeMass& mass : grains) {
        Window& window = window_[at(mass.grain)];
        const std::size_t node = at((y - window.y0) * window.nx + x - window.x0);
        window.row[node] = static_cast<int>(window.share.size());
        window.share.push_back(static_cast<int>(share_.size()));
        share_.push_back({mass.grain, window.row[node], window.mass[node], window.gradient[node],
                          Vec2::Zero(), Vec2::Zero()});
    }
    const int end = static_cast<int>(share_.size());
    for (int a = first; a < end; ++a) {
        const Share& own = share_[at(a)];
        for (int w = 3; w >= 0; --w)
            if (wall[at(w)])
                contact_.push_back({x, y, own.grain, -1 - w, a, -1, wall_normal(w), settings_.wall_friction,
                                    own.mass, Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()});
        for (int b = a + 1; b < end; ++b) {
            const Share& other = share_[at(b)];
            const Vec2 n = own.gradient - other.gradient;
            if (n.isZero(0.0)) continue;
            contact_.push_back({x, y, own.grain, other.grain, a, b, n.normalized(), settings_.friction,
                                own.mass * other.mass / (own.mass + other.mass), Vec2::Zero(), Vec2::Zero(),
                                Vec2::Zero(), Vec2::Zero()});
        }
    }
}

void CommonGrid::find_rows(std::size_t g) {
    Window& window = window_[g];
    window.rows = {};
    if (window.share.empty()) return;
    const ReferenceDisc& disc = *grains_.disc;
    const std::size_t nodes = disc.nodes();
    const double density = grains_.grain[g].density * grains_.grain[g].area;
    std::vector<double> row(window.share.size() * nodes, 0.0);
    for (std::size_t p = 0; p < disc.points(); ++p) {
        const Corners corners(window.point[p], spacing_);
        const std::size_t node = at((corners.y - window.y0) * window.nx + corners.x - window.x0);
        for (std::size_t k = 0; k < 4; ++k) {
            const int r = window.row[node + k % 2 + (k / 2) * at(window.nx)];
            if (r < 0) continue;
            const double share =
                density * disc.weight[p] * corners.value[k] / share_[at(window.share[at(r)])].mass;
            const auto of = disc.at_points.nodes(p);
            const auto N = disc.at_points.values(p);
            for (std::size_t m = 0; m < of.size(); ++m) row[at(r) * nodes + at(of[m])] += share * N[m];
        }
    }
    for (std::size_t r = 0; r < window.share.size(); ++r) {
        for (std::size_t m = 0; m < nodes; ++m) {
            if (row[r * nodes + m] == 0.0) continue;
            window.rows.node.push_back(static_cast<int>(m));
            window.rows.value.push_back(row[r * nodes + m]);
        }
        window.rows.start.push_back(static_cast<int>(window.rows.node.size()));
    }
}

void CommonGrid::remember(const std::vector<NodeContact>& before, double factor) {
    const auto key = [](const NodeContact& c) { return std::tuple(c.y, c.x, c.i, c.j); };
    std::size_t k = 0;
    for (NodeContact& c : contact_) {
        while (k < before.size() && key(before[k]) < key(c)) ++k;
        if (k == before.size() || key(before[k]) != key(c)) continue;
        c.impulse = c.ahead = factor * before[k].impulse;
        push(c, c.impulse);
    }
}

void CommonGrid::find_velocities(std::span<const Vec2> v) {
    const std::size_t nodes = grains_.nodes();
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < window_.size(); ++g)
        for (std::size_t r = 0; r < window_[g].share.size(); ++r)
            share_[at(window_[g].share[r])].velocity = window_[g].rows.at(r, v.subspan(g * nodes, nodes));
}

Vec2 CommonGrid::relative_velocity(const NodeContact& c) const {
    const auto velocity = [](const Share& share) -> Vec2 {
        return share.velocity + share.impulse / share.mass;
    };
    return velocity(share_[at(c.a)]) - (c.b >= 0 ? velocity(share_[at(c.b)]) : wall_velocity_[at(-1 - c.j)]);
}

bool CommonGrid::sweep() {
    double change = 0.0, size = 0.0;
    for (NodeContact& c : contact_) {
        const Vec2 tangent = perpendicular(c.normal);
        const Vec2 stopped = c.ahead - c.mass * relative_velocity(c);
        const double normal = std::max(0.0, c.normal.dot(stopped));
        const double slides = c.mu * normal;
        c.before = c.impulse;
        c.impulse = normal * c.normal + std::clamp(tangent.dot(stopped), -slides, slides) * tangent;
        push(c, c.impulse - c.ahead);
        change += (c.impulse - c.ahead).squaredNorm() / c.mass;
        size += c.impulse.squaredNorm() / c.mass;
    }
    return change <= settings_.tolerance * settings_.tolerance * size;
}

void CommonGrid::look_ahead() {
    double back = 0.0;
    for (const NodeContact& c : contact_) back += (c.ahead - c.impulse).dot(c.impulse - c.before) / c.mass;
    const double last = std::exchange(momentum_, 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum_ * momentum_)));
    const double factor = back > 0.0 ? 0.0 : (last - 1.0) / momentum_;
    if (back > 0.0) momentum_ = 1.0;
    for (NodeContact& c : contact_) {
        c.ahead = c.impulse + factor * (c.impulse - c.before);
        push(c, c.ahead - c.impulse);
    }
}

void CommonGrid::push(const NodeContact& c, const Vec2& impulse) {
    share_[at(c.a)].impulse += impulse;
    if (c.b >= 0) share_[at(c.b)].impulse -= impulse;
}

void CommonGrid::apply(std::span<Vec2> v) {
    const std::size_t nodes = grains_.nodes();
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < window_.size(); ++g) {
        const Window& window = window_[g];
        if (window.share.empty()) continue;
        std::vector<Vec2> by(nodes, Vec2::Zero());
        for (std::size_t r = 0; r < window.share.size(); ++r) {
            Share& share = share_[at(window.share[r])];
            const auto node = window.rows.nodes(r);
            const auto value = window.rows.values(r);
            for (std::size_t k = 0; k < node.size(); ++k) by[at(node[k])] += value[k] * share.impulse;
            share.impulse = Vec2::Zero();
        }
        mass_.solve(by);
        const double density = grains_.grain[g].density * grains_.grain[g].area;
        for (std::size_t m = 0; m < nodes; ++m) v[g * nodes + m] += by[m] / density;
    }
}

/// Over a step, forces of the grains included, impulses do the work impulse . (velocity before + after) / 2.
void CommonGrid::take_stock(double dt) {
    wall_force_.fill(Vec2::Zero());
    impact_ = friction_ = work_of_walls_ = 0.0;
    for (const NodeContact& c : contact_) {
        const Vec2 mean = 0.5 * (c.approach + relative_velocity(c)), tangent = perpendicular(c.normal);
        impact_ -= c.impulse.dot(c.normal) * mean.dot(c.normal);
        friction_ -= c.impulse.dot(tangent) * mean.dot(tangent);
        if (c.b >= 0) continue;
        wall_force_[at(-1 - c.j)] -= c.impulse / dt;
        work_of_walls_ += c.impulse.dot(wall_velocity_[at(-1 - c.j)]);
    }
}

std::vector<GrainContact> CommonGrid::grain_contacts() const {
    std::map<std::pair<int, int>, GrainContact> sum;
    std::map<std::pair<int, int>, double> pressed;
    for (const NodeContact& c : contact_) {
        if (c.impulse.isZero(0.0)) continue;
        const std::pair key(c.i, c.j);
        GrainContact& contact =
            sum.try_emplace(key, GrainContact{c.i, c.j, Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), 0.0})
                .first->second;
        const double weight = c.impulse.dot(c.normal);
        contact.point += weight * spacing_ * Vec2(c.x, c.y);
        contact.normal -= weight * c.normal;
        contact.force += c.impulse / dt_;
        pressed[key] += weight;
    }
    std::vector<GrainContact> found;
    for (auto& [key, contact] : sum) {
        contact.point /= pressed[key];
        contact.normal.normalize();
        found.push_back(contact);
    }
    return found;
}

}  // namespace softgrain::mpm
