// Neighbour list, blocks, and what contacts remember across a new list.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "common/errors.hpp"
#include "common/space_order.hpp"
#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {
namespace {

/// Lists between two sorts in space: grains drift apart slowly.
constexpr int listings_between_sorts = 16;

// Skin by motion: more skin costs work on pairs apart, less costs lists. With u the distance that the fastest
// grain goes in a step, D the mean diameter and `listing_cost` the cost of listing a grain in units of a
// pair, pairs_per_diameter skin / D + listing_cost 2 u / skin is least at skin = sqrt(2 listing_cost u D /
// pairs_per_diameter).
constexpr double listing_cost = 60.0, pairs_per_diameter = 3.4;
constexpr double first_skin = 0.1, least_skin = 0.02, most_skin = 0.5;  ///< mean diameters
/// The bound on motion may fall short by what a cell stretches between two lists.
constexpr double stretch_margin = 1.1;

}  // namespace

/// A bond holds until its spring is stretched by its strength.
double RigidDem::reach_of(std::size_t grain) const {
    const double R = radius_[grain];
    return R + 2.0 * R * law_.between_grains.adhesion / (law_.stiffness * elasticity_of(grain).modulus);
}

/// How the cell has changed since the listing; `loss`: of the smaller stretch, against 1.
Deformation RigidDem::deformation_since_listing(double& loss) const {
    loss = 0.0;
    if (!box_.periodic) return {};
    const CellChange change = cell_change(neighbors_.built_cell(), box_.flipped(flips_));
    loss = change.loss;
    return {change.F(0, 0), change.F(0, 1), change.F(1, 1), change.shift.x(), change.shift.y()};
}

/// True if a pair or wall not listed could touch.
bool RigidDem::list_is_stale() {
    double loss = 0.0;
    const Deformation by = deformation_since_listing(loss);
    double room = 0.5 * skin_ * (1.0 - loss) - loss * largest_radius_;
    if (!box_.periodic)
        for (std::size_t w = 0; w < 4; ++w)
            room = std::min(room,
                            0.5 * skin_ - std::abs(box_.position[w] - neighbors_.built_cell().position[w]));
    if (!(room > 0.0)) return true;
    if (stretch_margin * travelled_ < room) return false;
    const double* const before = neighbors_.built_at().data()->data();
    std::vector<double> moved2(blocks_.size());
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        moved2[b] =
            largest_displacement2(&record_[blocks_[b].first_record], before + 2 * blocks_[b].first_grain,
                                  static_cast<int>(blocks_[b].grains), by);
    travelled_ = std::sqrt(*std::max_element(moved2.begin(), moved2.end()));
    return !(stretch_margin * travelled_ < room);
}

double RigidDem::skin_by_motion() const {
    const auto n = static_cast<double>(radius_.size());
    double sum = 0.0;
    for (const double r : radius_) sum += 2.0 * r;
    const double diameter = sum / n;
    if (law_.skin) return *law_.skin * smallest_radius_;
    if (steps_listed_ == 0) return first_skin * diameter;
    const double per_step = travelled_ / static_cast<double>(steps_listed_);
    return std::clamp(std::sqrt(2.0 * listing_cost * per_step * diameter / pairs_per_diameter),
                      least_skin * diameter, most_skin * diameter);
}

/// What contacts remember, by the grain with the smaller number.
struct RigidDem::ContactBook {
    std::vector<std::uint32_t> start;    ///< [n + 1] into partner
    std::vector<std::uint32_t> partner;  ///< number of the other grain
    std::vector<double> value;  ///< of each, `values` numbers; a moment is that on the smaller number
    std::size_t values = 0;
    std::map<std::pair<std::size_t, int>, ContactMemory> at_walls;  ///< by grain and wall
};

/// True if the pair remembers nothing.
bool RigidDem::forgets(const Block& block, std::size_t pair) const {
    return std::all_of(memories.begin(), memories.end(), [&](const auto memory) {
        return (block.*memory).empty() || (block.*memory)[pair] == 0.0;
    });
}

RigidDem::ContactBook RigidDem::open_book() const {
    ContactBook book;
    const std::size_t n = radius_.size();
    const auto& any = blocks_.front();
    for (const auto memory : memories) book.values += (any.*memory).empty() ? 0 : 1;
    for (std::size_t b = 0; b < wall_contacts_.size(); ++b)
        for (const WallContact& contact : wall_contacts_[b])
            book.at_walls[{grain_of(blocks_[b], contact), contact.wall}] = contact.memory;
    if (book.values == 0) return book;

    const auto each_remembered = [&](const auto& visit) {
        for (const Block& block : blocks_)
            each_pair(block, [&](std::size_t i, std::size_t j, std::size_t pair) {
                if (!forgets(block, pair)) visit(block, pair, i, j);
            });
    };
    book.start.assign(n + 1, 0);
    each_remembered(
        [&](const Block&, std::size_t, std::size_t i, std::size_t j) { ++book.start[std::min(i, j) + 1]; });
    for (std::size_t g = 0; g < n; ++g) book.start[g + 1] += book.start[g];
    book.partner.resize(book.start[n]);
    book.value.resize(book.values * book.start[n]);
    std::vector<std::uint32_t> fill(book.start.begin(), book.start.end() - 1);
    each_remembered([&](const Block& block, std::size_t pair, std::size_t i, std::size_t j) {
        const std::size_t entry = fill[std::min(i, j)]++;
        book.partner[entry] = static_cast<std::uint32_t>(std::max(i, j));
        std::size_t next = book.values * entry;
        for (const auto memory : memories)
            if (!(block.*memory).empty())
                book.value[next++] = (block.*memory)[pair] * (memory == &Block::moment && i > j ? -1.0 : 1.0);
    });
    return book;
}

/// A new list for the present positions, with the memory of their contacts.
void RigidDem::list_again() {
    skin_ = skin_by_motion();
    flips_ = box_.periodic ? box_.flips() : 0;
    if (box_.periodic) wrap(walls_.flipped(flips_));
    force_ = {};
    const bool sorts = ++listings_ % listings_between_sorts == 0;
    std::vector<int> places;
    if (sorts) places = places_in_space();
    std::vector<Vec2> x;
    std::vector<GrainMotion> motion;
    x.reserve(radius_.size());
    motion.reserve(radius_.size());
    for (std::size_t s = 0; s < radius_.size(); ++s) {
        const GrainRecord& g = record_[record_of(sorts ? static_cast<std::size_t>(places[s]) : s)];
        x.push_back({g.x, g.y});
        motion.push_back({g.vx, g.vy, g.spin});
    }
    record_ = {};
    const ContactBook book = open_book();
    blocks_.clear();
    wall_contacts_.clear();
    if (sorts) {
        const std::vector<std::uint32_t> before = order_;
        for (std::size_t s = 0; s < order_.size(); ++s)
            order_[s] = before[static_cast<std::size_t>(places[s])];
        places = {};
    }
    travelled_ = 0.0;
    steps_listed_ = 0;
    list_neighbors(std::move(x));
    set_motion(motion);
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < blocks_.size(); ++b) copy_memory(book, b);
}

/// A new spatial order, by places in the present one.
std::vector<int> RigidDem::places_in_space() const {
    std::vector<Vec2> x;
    x.reserve(radius_.size());
    each_grain([&](std::size_t, std::size_t r) { x.push_back({record_[r].x, record_[r].y}); });
    return space_order(x, sorting_cell());
}

/// Side of a square with the mean area of a grain [m].
double RigidDem::sorting_cell() const {
    const double area = std::accumulate(reference_area_.begin(), reference_area_.end(), 0.0);
    return std::sqrt(area / static_cast<double>(radius_.size()));
}

/// By grains in spatial order.
void RigidDem::set_motion(const std::vector<GrainMotion>& motion) {
    for (std::size_t s = 0; s < motion.size(); ++s) {
        GrainRecord& g = record_[record_of(s)];
        g.vx = motion[s].vx;
        g.vy = motion[s].vy;
        g.spin = motion[s].spin;
        g.rim_speed = g.spin * g.radius;
    }
}

/// Clumps must not meet their own images, and each other in one image only.
void RigidDem::require_room_for_clumps() const {
    const double room = 4.0 * clumps_->largest_reach();
    if (!box_.periodic || box_.flipped(flips_).spacing() > room) return;
    throw InputError(fmt::format(
        "the periodic cell is {:.4g} m across, clumps of this size need {:.4g} m: take more grains",
        box_.flipped(flips_).spacing(), room));
}

/// Blocks for grains at rest in spatial order, without memory.
void RigidDem::list_neighbors(std::vector<Vec2> x) {
    record_ = {};
    force_ = {};
    std::vector<double> reach;
    reach.reserve(x.size());
    for (const std::uint32_t grain : order_) reach.push_back(reach_of(grain));
    neighbors_.build(std::move(x), std::move(reach), skin_, box_.flipped(flips_));
    if (clumps_) {
        require_room_for_clumps();
        neighbors_.keep_if([&](int i, int j) {
            return owner(order_[static_cast<std::size_t>(i)]) != owner(order_[static_cast<std::size_t>(j)]);
        });
    }
    std::vector<char> driven;
    if (!driven_.empty())
        for (const std::uint32_t grain : order_) driven.push_back(is_driven(grain) ? 1 : 0);
    blocks_ = cut_into_blocks(neighbors_, order_.size(),
                              rest_.used() ? grains_per_resting_block : grains_per_block, driven);
    if (clumps_) clumps_->find_discs(order_, blocks_);
    neighbors_.forget_pairs();
    record_.assign(blocks_.back().first_record + blocks_.back().grains + blocks_.back().halo.size(), {});
    force_.assign(record_.size(), {});
    totals_.assign(blocks_.size(), {});
    wall_contacts_.resize(blocks_.size());
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < blocks_.size(); ++b) fill_block(b);
    start_rest();
}

void RigidDem::fill_block(std::size_t b) {
    Block& block = blocks_[b];
    for (std::size_t g = 0; g < block.grains; ++g) {
        const std::uint32_t grain = order_[block.first_grain + g];
        const Vec2& at = neighbors_.built_at()[block.first_grain + g];
        const bool moves_as_told = is_driven(grain);
        record_[block.first_record + g] = {.x = at.x(),
                                           .y = at.y(),
                                           .radius = radius_[grain],
                                           .inverse_mass = moves_as_told ? 0.0 : 1.0 / mass_[grain]};
        if (!moves_as_told) continue;
        const std::size_t d = grain - free_grains();
        driven_record_[d] = block.first_record + g;
        block.is_driven = block.is_driven || driven_[d].spin != 0.0 || !driven_[d].velocity.isZero(0.0);
    }
    prepare_pairs(block);
    if (!box_.periodic) list_walls(b);
}

/// Grains that may touch a wall before the next list.
void RigidDem::list_walls(std::size_t b) {
    const Block& block = blocks_[b];
    wall_contacts_[b].clear();
    for (std::size_t g = 0; g < block.grains; ++g)
        for (int w = 0; w < 4; ++w) {
            const GrainRecord& grain = record(block, g);
            if (wall_overlap(grain, w, box_) <= -skin_ || grain.inverse_mass == 0.0) continue;
            const ContactStiffness stiffness =
                stiffness_at_wall(law_, elasticity_of(order_[block.first_grain + g]));
            wall_contacts_[b].push_back({static_cast<std::uint32_t>(block.first_record + g),
                                         static_cast<std::uint8_t>(w),
                                         stiffness,
                                         {}});
        }
}

/// Stiffness of its pairs, and an empty memory.
void RigidDem::prepare_pairs(Block& block) const {
    const std::size_t padded = block.padded(), count = uniform_ ? lanes : padded;
    for (auto* array : {&block.k, &block.shear_ratio, &block.shear_compliance}) array->assign(count, 1.0);
    const auto set = [&](std::size_t at, const ContactStiffness& own) {
        block.k[at] = own.k;
        block.shear_ratio[at] = own.shear_ratio;
        block.shear_compliance[at] = 1.0 / (own.shear_ratio * own.k);
    };
    if (uniform_) {
        const GrainElasticity any = elasticity_of(0);
        for (std::size_t l = 0; l < lanes; ++l) set(l, stiffness_of_pair(law_, any, any));
    } else {
        each_pair(block, [&](std::size_t i, std::size_t j, std::size_t pair) {
            set(pair, stiffness_of_pair(law_, elasticity_of(i), elasticity_of(j)));
        });
    }
    const auto prepare = [&](std::vector<double>& memory, bool wanted) {
        if (wanted) memory.assign(padded, 0.0);
    };
    prepare(block.shear, law_.features & has_friction);
    prepare(block.dashpot, law_.features & has_damping);
    prepare(block.grip, law_.hertz && (law_.features & has_friction));
    prepare(block.moment, law_.features & has_rolling);
    prepare(block.bond, law_.features & has_adhesion);
}

void RigidDem::copy_memory(const ContactBook& book, std::size_t b) {
    Block& block = blocks_[b];
    for (WallContact& contact : wall_contacts_[b]) {
        const auto old = book.at_walls.find({grain_of(block, contact), contact.wall});
        if (old != book.at_walls.end()) contact.memory = old->second;
    }
    if (book.values == 0) return;
    each_pair(block, [&](std::size_t i, std::size_t j, std::size_t pair) {
        const auto first = book.partner.begin() + book.start[std::min(i, j)],
                   last = book.partner.begin() + book.start[std::min(i, j) + 1];
        const auto found = std::find(first, last, std::max(i, j));
        if (found == last) return;
        std::size_t next = book.values * static_cast<std::size_t>(found - book.partner.begin());
        for (const auto memory : memories)
            if (!(block.*memory).empty())
                (block.*memory)[pair] = book.value[next++] * (memory == &Block::moment && i > j ? -1.0 : 1.0);
    });
}

}  // namespace softgrain::rigid_dem
