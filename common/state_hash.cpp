#include "common/state_hash.hpp"

#include "common/hash.hpp"

namespace softgrain {
namespace {

void add(Hash& hash, const Vec2& vector) {
    hash.add(vector.x());
    hash.add(vector.y());
}

void add(Hash& hash, std::span<const Vec2> vectors) {
    for (const Vec2& vector : vectors) add(hash, vector);
}

void add(Hash& hash, const EnergyLedger& energy) {
    for (const double part : {energy.kinetic, energy.elastic, energy.external_work, energy.damping,
                              energy.friction, energy.impact, energy.plastic, energy.adhesion})
        hash.add(part);
}

}  // namespace

std::uint64_t state_hash(const GrainView& view) {
    Hash hash;
    hash.add(view.time);
    hash.add(std::span<const double>(view.box.position));
    hash.add(view.box.tilt);
    add(hash, view.wall_force);
    add(hash, view.energy);
    add(hash, view.centroid);
    add(hash, view.velocity);
    hash.add(view.area);
    for (const Mat2& stress : view.stress)
        for (const double component : {stress(0, 0), stress(0, 1), stress(1, 0), stress(1, 1)})
            hash.add(component);
    for (const GrainContact& contact : view.contacts) {
        hash.add(static_cast<std::uint64_t>(contact.i));
        hash.add(static_cast<std::uint64_t>(contact.j));
        add(hash, contact.point);
        add(hash, contact.force);
        hash.add(contact.length);
    }
    return hash.value();
}

}  // namespace softgrain
