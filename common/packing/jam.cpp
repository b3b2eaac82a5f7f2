#include "common/packing/jam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/errors.hpp"
#include "common/packing/overlap_energy.hpp"
#include "common/packing/random_sequential.hpp"

namespace softgrain {
namespace {

// Lengths are in mean radii.
constexpr double first_fraction = 0.5;       // random placement; far below jamming
constexpr double first_gas_fraction = 0.35;  // random places without overlap, between walls
constexpr double compression = 0.004;        // of the box size, in one step
constexpr double free_overlap = 1e-6;        // below it discs count as free while they are compressed
constexpr double coarse_balance = 1e-3;      // net force / mean overlap of discs that carry each other
constexpr double fine_balance = 1e-4;        // the same, at the jamming point
constexpr double weakest_contact = 1e-3;     // overlap / mean overlap of a contact that carries
constexpr double no_limit = 2.0;             // a packing fraction that no discs reach
constexpr int most_steps = 50'000;           // of one relaxation
constexpr int most_refinements = 100;

/// How discs are brought together, by a factor of the box size: with the box or by its walls.
using Squeeze = void (OverlapEnergy::*)(double);

double fraction_of(const OverlapEnergy& discs) {
    return disc_area(discs.radius()) / discs.box().area();
}

void open_to(OverlapEnergy& discs, double fraction) {
    discs.scale(std::sqrt(fraction_of(discs) / fraction));
}

/// Discs at random between the walls, or anywhere in a periodic cell; they may overlap.
OverlapEnergy placed_at_random(const std::vector<double>& radii, const PackingRequest& request,
                               double fraction, Random& random) {
    const Box box = request.box_for(radii, fraction);
    const auto coordinate = [&](double r, double length) {
        if (request.periodic) return random.between(0.0, length);
        return 2.0 * r < length ? random.between(r, length - r) : 0.5 * length;
    };
    std::vector<Vec2> center;
    for (const double r : radii) {
        const double x = coordinate(r, box.width());
        center.emplace_back(x, coordinate(r, box.height()));
    }
    return {radii, std::move(center), box};
}

/// Compresses free discs until they reach `fraction`; false if they jam before.
bool compress(OverlapEnergy& discs, Squeeze squeeze, double fraction) {
    for (;;) {
        const double still_free =
            fraction_of(discs) < fraction ? free_overlap : 1e-3 * free_overlap * discs.smallest_radius();
        if (discs.relax(coarse_balance, still_free, most_steps).largest_overlap > still_free) return false;
        const double left = std::sqrt(fraction_of(discs) / fraction);
        if (left >= 1.0) return true;
        (discs.*squeeze)(std::max(1.0 - compression, left));
    }
}

/// From jammed discs to the point where their overlaps vanish. A jammed state tells how far that is: U is
/// quadratic in the distance, so ln(size at jamming / size) = 2 U / virial.
OverlapEnergy::State close_in(OverlapEnergy& discs, Squeeze squeeze) {
    constexpr double still_free = 0.02 * jamming_tolerance;
    double change = compression;
    bool was_free = false;
    for (int k = 0; k < most_refinements; ++k) {
        const auto state = discs.relax(fine_balance, still_free, most_steps);
        const bool is_free = state.largest_overlap <= still_free;
        if (!is_free && state.largest_overlap < jamming_tolerance) return state;
        if (!is_free)
            change = 0.9 * 2.0 * state.energy / state.virial;
        else
            change = was_free ? 2.0 * change : -0.5 * std::abs(change);  // opened too far: go back
        was_free = is_free;
        (discs.*squeeze)(1.0 + change);
    }
    throw InputError("packing: the grains did not come to rest at their jamming point, change random.seed");
}

Packing in_units_of(double length, const OverlapEnergy& discs, const std::vector<double>& radii) {
    Packing packing;
    const Box& box = discs.box();
    packing.box = Box{{0.0, length * box.width(), 0.0, length * box.height()}, box.periodic};
    packing.center = discs.center();
    for (Vec2& c : packing.center) {
        if (box.periodic) c = box.wrapped(c);
        c *= length;
    }
    packing.radius = radii;
    return packing;
}

double mean_of(const std::vector<double>& radii) {
    return std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
}

std::vector<double> in_units_of(double length, std::vector<double> radii) {
    for (double& r : radii) r /= length;
    return radii;
}

/// `radii` before they were divided by their mean.
JammedPacking brought_together(OverlapEnergy& discs, const std::vector<double>& radii,
                               const PackingRequest& request, Squeeze squeeze) {
    const auto& packing_fraction = request.packing_fraction;
    const double limit = request.disc_fraction_or(no_limit);
    // A little beyond the limit, so that opening the box to it leaves no overlap.
    std::vector<Pair> contacts;
    if (!compress(discs, squeeze, limit * (1.0 + free_overlap))) {
        const auto state = close_in(discs, squeeze);
        contacts = discs.contacts(weakest_contact * state.mean_overlap);
        discs.scale(1.0 + discs.opening());
        const double jammed_at = fraction_of(discs);
        if (packing_fraction && jammed_at < limit)
            throw InputError(
                fmt::format("packing.packing_fraction {} cannot be reached: these grains jam at {:.4f}; "
                            "lower it or leave it out",
                            *packing_fraction, jammed_at * request.grain_share));
        if (packing_fraction) contacts.clear();
    }
    if (packing_fraction) open_to(discs, limit);

    JammedPacking result{carrying_discs(contacts, radii.size()), {}, 0.0};
    result.packing = in_units_of(mean_of(radii), discs, radii);
    result.packing_fraction = result.packing.packing_fraction_undeformed();
    return result;
}

}  // namespace

CarryingDiscs carrying_discs(const std::vector<Pair>& contacts, std::size_t n) {
    CarryingDiscs result;
    std::vector<bool> held(n, true);
    const auto alive = [&](const Pair& c) {
        return held[static_cast<std::size_t>(c.i)] && (c.j < 0 || held[static_cast<std::size_t>(c.j)]);
    };
    for (bool changed = true; changed;) {
        std::vector<int> count(n, 0);
        for (const Pair& c : contacts) {
            if (!alive(c)) continue;
            ++count[static_cast<std::size_t>(c.i)];
            if (c.j >= 0) ++count[static_cast<std::size_t>(c.j)];
        }
        changed = false;
        for (std::size_t i = 0; i < n; ++i)
            if (held[i] && count[i] < 3) {
                held[i] = false;
                changed = true;
            }
    }
    const auto remaining = static_cast<int>(std::count(held.begin(), held.end(), true));
    const auto between_grains =
        std::count_if(contacts.begin(), contacts.end(), [&](const Pair& c) { return alive(c) && c.j >= 0; });
    result.rattlers = static_cast<int>(n) - remaining;
    result.contacts = static_cast<int>(std::count_if(contacts.begin(), contacts.end(), alive));
    if (remaining > 0) result.coordination_number = 2.0 * static_cast<double>(between_grains) / remaining;
    return result;
}

JammedPacking jam(const std::vector<double>& radii, const PackingRequest& request, Random& random) {
    OverlapEnergy discs =
        placed_at_random(in_units_of(mean_of(radii), radii), request,
                         std::min(first_fraction, request.disc_fraction_or(no_limit)), random);
    return brought_together(discs, radii, request, &OverlapEnergy::scale);
}

JammedPacking compact(const std::vector<double>& radii, const PackingRequest& request, Random& random) {
    PackingRequest gas = request;
    gas.packing_fraction =
        std::min(first_gas_fraction, request.disc_fraction_or(no_limit)) * request.grain_share;
    Packing loose = random_sequential(in_units_of(mean_of(radii), radii), gas, random);
    OverlapEnergy discs(std::move(loose.radius), std::move(loose.center), loose.box);
    return brought_together(discs, radii, request, &OverlapEnergy::move_walls);
}

}  // namespace softgrain
