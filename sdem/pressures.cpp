#include "sdem/pressures.hpp"

#include <algorithm>

namespace softgrain::sdem {
namespace {

/// A block, and the rows that the fullest block so far needed.
struct Workspace {
    PressureBlock block;
    std::vector<OverlapRow> rows;
    double nowhere = 0.0;

    void clear(std::size_t row_count) {
        if (rows.size() < row_count) rows.resize(row_count);
        for (std::size_t k = 0; k < row_count; ++k) {
            std::fill_n(rows[k].overlap, grains_per_block, 0.0);
            std::fill_n(rows[k].share, grains_per_block, 0.0);
            std::fill_n(rows[k].to, grains_per_block, &nowhere);
        }
    }
};

std::size_t candidates_of(const ContactList& list, std::size_t g) {
    return list.wall_first(g + 1) - list.wall_first(g) + list.first(g + 1) - list.first(g) +
           list.second(g).size();
}

/// All that grain g touches into lane l, one contact a row; the number of them. What does not touch is
/// overwritten by what follows, or stays with an overlap of 0.
std::size_t gather(std::vector<OverlapRow>& rows, std::size_t l, const ContactList& list, SideValues& values,
                   std::size_t g) {
    std::size_t count = 0;
    const auto put = [&](const Contact& c, double share, double* to) {
        OverlapRow& row = rows[count];
        row.overlap[l] = share * c.lens();
        row.share[l] = share;
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
    std::size_t most = 0, rows = 0;
    for (std::size_t g = begin; g < end; ++g) most = std::max(most, candidates_of(list, g));
    space.clear(most + 1);  // the last candidate of a full grain is tried there
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
        rows = std::max(rows, gather(space.rows, l, list, values, g));
    }
    block.count = static_cast<int>(end - begin);
    block.rows = static_cast<int>(rows);
    block.row = space.rows.data();
    return block;
}

void scatter(const PressureBlock& block) {
    for (int k = 0; k < block.rows; ++k)
        for (int l = 0; l < block.count; ++l) *block.row[k].to[l] = block.row[k].answer[l];
}

Workspace& workspace() {
    static thread_local Workspace space;
    return space;
}

}  // namespace

std::size_t find_pressures(const Grains& grains, GrainLaw law, double smallest, const ContactList& list,
                           Pressures& pressures, std::size_t begin, std::size_t end) {
    PressureBlock& block = load(workspace(), grains, list, pressures.push, begin, end);
    find_pressures(block, law);
    scatter(block);
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
    PressureBlock& block = load(workspace(), grains, list, resistance, begin, end);
    for (std::size_t g = begin; g < end; ++g) {
        const std::size_t l = g - begin;
        const Inflated& grain = inflated[g];
        block.pressure[l] = grain.pressure;
        block.per_area[l] = grain.per_area;
        block.at_q0[l] = grain.at_q0;
        block.at_q1[l] = grain.at_q1;
        block.at_q1_squared[l] = grain.at_q1_squared;
    }
    find_resistances(block);
    scatter(block);
}

double resistance_of(const Grains& grains, std::span<const Inflated> inflated, std::size_t g, double lens,
                     double share) {
    const GrainMaterial& material = grains.material_of(g);
    return resistance(inflated[g], share * lens, share, grains.grain[g].reference_area(), material.plane_E,
                      LensPotential::bulk_stiffness(material.mu, material.kappa));
}

void find_pair_forces(const SideValues& push, ContactList& list, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
        Contact& c = list.pair_contact[k];
        c.q = c.touching() ? push.pair[k].i + push.pair[k].j : 0.0;
    }
}

void find_wall_forces(const SideValues& push, ContactList& list) {
    for (std::size_t w = 0; w < list.wall_contact.size(); ++w) {
        Contact& c = list.wall_contact[w];
        c.q = c.touching() ? push.wall[w] : 0.0;
    }
}

}  // namespace softgrain::sdem
