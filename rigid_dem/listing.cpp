// Neighbour list, blocks, and what contacts remember across a new list.
#include <algorithm>
#include <cmath>
#include <numeric>

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
            room = std::min(
                room, skin_ - std::abs(box_.position[w] - neighbors_.built_cell().position[w]) - 0.5 * skin_);
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

/// Contacts that remember something, by grain with the smaller number.
struct RigidDem::ContactBook {
    struct Entry {
        std::uint32_t partner;      ///< number of the other grain, or n + wall
        std::uint32_t block, pair;  ///< where its memory lies
        bool turned;                ///< the partner is the first of the pair
    };
    std::vector<std::uint32_t> start;  ///< [n + 1] into entry
    std::vector<Entry> entry;
    std::vector<Block> blocks;
    std::vector<std::vector<WallContact>> walls;

    const Entry* find(std::size_t grain, std::size_t partner) const {
        if (start.empty()) return nullptr;
        for (std::uint32_t e = start[grain]; e < start[grain + 1]; ++e)
            if (entry[e].partner == partner) return &entry[e];
        return nullptr;
    }
};

/// Takes blocks and walls out of use.
RigidDem::ContactBook RigidDem::close_book() {
    ContactBook book;
    const std::size_t n = radius_.size();
    book.start.assign(n + 1, 0);
    const auto each_remembered = [&](const auto& visit) {
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            const Block& block = blocks_[b];
            if (!block.has_memory()) continue;
            each_pair(block, [&](std::size_t i, std::size_t j, std::size_t pair) {
                if (!block.remembers(pair)) return;
                visit(std::min(i, j), std::max(i, j), b, pair, i > j);
            });
        }
        for (std::size_t b = 0; b < wall_contacts_.size(); ++b)
            for (std::size_t c = 0; c < wall_contacts_[b].size(); ++c) {
                const WallContact& contact = wall_contacts_[b][c];
                visit(grain_of(blocks_[b], contact), n + contact.wall, b, c, false);
            }
    };
    each_remembered([&](std::size_t grain, auto...) { ++book.start[grain + 1]; });
    for (std::size_t g = 0; g < n; ++g) book.start[g + 1] += book.start[g];
    book.entry.resize(book.start[n]);
    std::vector<std::uint32_t> fill(book.start.begin(), book.start.end() - 1);
    each_remembered([&](std::size_t grain, std::size_t partner, std::size_t block, std::size_t pair,
                        bool turned) {
        book.entry[fill[grain]++] = {static_cast<std::uint32_t>(partner), static_cast<std::uint32_t>(block),
                                     static_cast<std::uint32_t>(pair), turned};
    });
    book.blocks = std::move(blocks_);
    book.walls = std::move(wall_contacts_);
    blocks_.clear();
    wall_contacts_.clear();
    return book;
}

/// A new list for the present positions, with the memory of their contacts.
void RigidDem::list_again() {
    skin_ = skin_by_motion();
    flips_ = box_.periodic ? box_.flips() : 0;
    if (box_.periodic) wrap(walls_.flipped(flips_));
    std::vector<GrainRecord> own;
    own.reserve(radius_.size());
    each_grain([&](std::size_t, std::size_t r) { own.push_back(record_[r]); });
    const ContactBook book = close_book();
    if (listings_ % listings_between_sorts == 0) sort_in_space(own);
    ++listings_;
    travelled_ = 0.0;
    steps_listed_ = 0;
    list_neighbors(own);
    for (Block& block : blocks_) copy_memory(book, block);
    for (std::size_t b = 0; b < wall_contacts_.size(); ++b)
        for (WallContact& contact : wall_contacts_[b]) {
            const std::size_t grain = grain_of(blocks_[b], contact);
            if (const auto* entry = book.find(grain, radius_.size() + contact.wall))
                contact.memory = book.walls[entry->block][entry->pair].memory;
        }
}

void RigidDem::sort_in_space(std::vector<GrainRecord>& own) {
    std::vector<Vec2> x;
    x.reserve(own.size());
    for (const GrainRecord& g : own) x.push_back({g.x, g.y});
    const double mean_area = std::accumulate(reference_area_.begin(), reference_area_.end(), 0.0) /
                             static_cast<double>(own.size());
    const std::vector<int> places = space_order(x, std::sqrt(mean_area));
    const std::vector<GrainRecord> old = own;
    const std::vector<std::uint32_t> old_order = order_;
    for (std::size_t s = 0; s < own.size(); ++s) {
        own[s] = old[static_cast<std::size_t>(places[s])];
        order_[s] = old_order[static_cast<std::size_t>(places[s])];
    }
}

/// Blocks for grains in spatial order, without memory.
void RigidDem::list_neighbors(const std::vector<GrainRecord>& own) {
    std::vector<Vec2> x;
    std::vector<double> reach;
    x.reserve(own.size());
    reach.reserve(own.size());
    for (std::size_t s = 0; s < own.size(); ++s) {
        x.push_back({own[s].x, own[s].y});
        reach.push_back(reach_of(order_[s]));
    }
    neighbors_.build(x, reach, skin_, box_.flipped(flips_));
    blocks_ = cut_into_blocks(neighbors_, own.size());
    record_.assign(blocks_.back().first_record + blocks_.back().grains + blocks_.back().halo.size(), {});
    force_.assign(record_.size(), {});
    for (const Block& block : blocks_)
        std::copy_n(own.begin() + static_cast<std::ptrdiff_t>(block.first_grain), block.grains,
                    record_.begin() + static_cast<std::ptrdiff_t>(block.first_record));
    for (Block& block : blocks_) prepare_pairs(block);
    wall_contacts_.resize(blocks_.size());
    for (std::size_t b = 0; b < blocks_.size() && !box_.periodic; ++b) list_walls(b);
}

/// Grains that may touch a wall before the next list.
void RigidDem::list_walls(std::size_t b) {
    const Block& block = blocks_[b];
    wall_contacts_[b].clear();
    for (std::size_t g = 0; g < block.grains; ++g)
        for (int w = 0; w < 4; ++w) {
            const GrainRecord& grain = record(block, g);
            if (wall_overlap(grain, w, box_) <= -skin_) continue;
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

void RigidDem::copy_memory(const ContactBook& book, Block& block) const {
    if (!block.has_memory()) return;
    each_pair(block, [&](std::size_t i, std::size_t j, std::size_t pair) {
        const auto* entry = book.find(std::min(i, j), std::max(i, j));
        if (entry == nullptr) return;
        const Block& old = book.blocks[entry->block];
        const auto copy = [&](const std::vector<double>& from, std::vector<double>& to) {
            if (!to.empty()) to[pair] = from[entry->pair];
        };
        copy(old.shear, block.shear);
        copy(old.dashpot, block.dashpot);
        copy(old.grip, block.grip);
        copy(old.bond, block.bond);
        copy(old.moment, block.moment);
        // A rolling moment is that on the first grain.
        if (!block.moment.empty() && entry->turned != (i > j)) block.moment[pair] *= -1.0;
    });
}

}  // namespace softgrain::rigid_dem
