#include "sdem/pressures.hpp"

#include <algorithm>

namespace softgrain::sdem {
namespace {

/// A block, and the rows that the fullest block so far needed. Between uses they hold no contact.
struct Workspace {
    PressureBlock block;
    std::vector<OverlapRow> rows;
    double nowhere = 0.0;  ///< where answers go that nobody asked for

    void make_room(std::size_t row_count) {
        while (rows.size() < row_count) {
            rows.push_back(OverlapRow{});
            clear(rows.back(), 0, grains_per_block);
        }
        block.row = rows.data();
    }
    void clear(OverlapRow& row, int from, int to) {
        std::fill(row.overlap + from, row.overlap + to, 0.0);
        std::fill(row.to + from, row.to + to, &nowhere);
    }
};

Workspace& workspace() {
    static thread_local Workspace space;
    return space;
}

std::size_t candidates_of(const ContactList& list, std::size_t g) {
    return list.wall_first(g + 1) - list.wall_first(g) + list.first(g + 1) - list.first(g) +
           list.second(g).size();
}

/// All that grain g touches into lane l, one contact a row; the number of them. A candidate that does not
/// touch is overwritten by the next one, or stays with an overlap of 0.
int gather(OverlapRow* rows, std::size_t l, const ContactList& list, SideValues& values, std::size_t g) {
    int count = 0;
    const auto put = [&](const Contact& c, double share, double* to) {
        OverlapRow& row = rows[count];
        row.overlap[l] = share * c.lens();
        row.to[l] = to;
        count += c.touching() ? 1 : 0;
    };
    for (std::size_t w = list.wall_first(g); w < list.wall_first(g + 1); ++w)
        put(list.wall_contact[w], 1.0, &values.wall[w]);
    for (std::size_t k = list.first(g); k < list.first(g + 1); ++k)
        put(list.pair_contact[k], list.share[k], &values.pair[k].i);
    for (const std::uint32_t k : list.second(g))
        put(list.pair_contact[k], 1.0 - list.share[k], &values.pair[k].j);
    return count;
}

/// The grains [begin, end) with all their contacts, whose answers are to go to `values`.
PressureBlock& load(Workspace& space, const Grains& grains, const ContactList& list, SideValues& values,
                    std::size_t begin, std::size_t end) {
    PressureBlock& block = space.block;
    std::size_t most = 0;
    for (std::size_t g = begin; g < end; ++g) most = std::max(most, candidates_of(list, g));
    space.make_room(most + 1);  // the last candidate of a full grain is tried there
    block.count = static_cast<int>(end - begin);
    std::fill(std::begin(block.rows), std::end(block.rows), 0);
    for (std::size_t g = begin; g < end; ++g) {
        const std::size_t l = g - begin;
        const Grain& grain = grains.grain[g];
        const GrainMaterial& material = grains.material_of(g);
        block.det[l] = grain.F.det();
        block.area[l] = grain.reference_area();
        block.mu[l] = material.mu;
        block.kappa[l] = material.kappa;
        block.plane_E[l] = material.plane_E;
        block.bulge[l] = material.bulge;
        int& rows = block.rows[l / PressureBlock::group];
        rows = std::max(rows, gather(block.row, l, list, values, g));
    }
    // A group has no end of its own.
    for (std::size_t l = end - begin; l % PressureBlock::group != 0; ++l) block.per_area[l] = 0.0;
    return block;
}

/// Answers to where they belong; no contact is left.
void scatter(Workspace& space) {
    PressureBlock& block = space.block;
    for (int from = 0; from < block.count; from += PressureBlock::group) {
        const int to = std::min(block.count, from + PressureBlock::group);
        const int rows = block.rows[from / PressureBlock::group];
        for (int k = 0; k < rows; ++k) {
            const OverlapRow& row = block.row[k];
            for (int l = from; l < to; ++l) *row.to[l] = row.answer[l];
        }
        for (int k = 0; k <= rows; ++k) space.clear(block.row[k], from, to);
    }
}

}  // namespace

std::size_t find_pressures(const Grains& grains, GrainLaw law, double smallest, const ContactList& list,
                           Pressures& pressures, std::size_t begin, std::size_t end) {
    Workspace& space = workspace();
    PressureBlock& block = load(space, grains, list, pressures.side, begin, end);
    find_pressures(block, law);
    scatter(space);
    std::size_t bad = grains.size();
    for (std::size_t g = begin; g < end; ++g) {
        const std::size_t l = g - begin;
        pressures.stress[g] = block.stress[l];
        pressures.inflated[g] = {block.pressure[l], block.per_area[l], block.at_q0[l], block.at_q1[l],
                                 block.at_q1_squared[l]};
        if (!(block.area_ratio[l] > smallest)) bad = std::min(bad, g);
    }
    return bad;
}

void find_resistances(const Grains& grains, const ContactList& list, std::span<const Inflated> inflated,
                      SideValues& resistance, std::size_t begin, std::size_t end) {
    Workspace& space = workspace();
    PressureBlock& block = load(space, grains, list, resistance, begin, end);
    for (std::size_t g = begin; g < end; ++g) {
        const std::size_t l = g - begin;
        block.pressure[l] = inflated[g].pressure;
        block.per_area[l] = inflated[g].per_area;
        block.at_q0[l] = inflated[g].at_q0;
        block.at_q1[l] = inflated[g].at_q1;
        block.at_q1_squared[l] = inflated[g].at_q1_squared;
    }
    find_resistances(block);
    scatter(space);
}

double resistance_of(const Grains& grains, std::span<const Inflated> inflated, std::size_t g,
                     double overlap) {
    const GrainMaterial& material = grains.material_of(g);
    return resistance(inflated[g], overlap, grains.grain[g].reference_area(), material.plane_E,
                      LensPotential::bulk_stiffness(material.mu, material.kappa));
}

void find_pair_forces(const SideValues& push, ContactList& list, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
        Contact& c = list.pair_contact[k];
        const double share = list.share[k];
        c.q = c.touching() ? share * push.pair[k].i + (1.0 - share) * push.pair[k].j : 0.0;
    }
}

void find_wall_forces(const SideValues& push, ContactList& list, std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w) {
        Contact& c = list.wall_contact[w];
        c.q = c.touching() ? push.wall[w] : 0.0;
    }
}

}  // namespace softgrain::sdem
