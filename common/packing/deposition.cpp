#include "common/packing/deposition.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "common/errors.hpp"
#include "common/packing/overlap_energy.hpp"
#include "common/packing/random_sequential.hpp"
#include "common/space_order.hpp"
#include "common/stop.hpp"

namespace softgrain {
namespace {

// Lengths are in mean radii.
constexpr double gas_fraction = 0.4;      // before the fall
constexpr double guess_inside = 0.83;     // packing fraction after it, without walls and lid
constexpr double guess_at_walls = 1.1;    // what they take from it, times sqrt(number of discs)
constexpr int most_falls = 6;             // until the width is right
constexpr double narrowest = 1.0 + 1e-3;  // width / largest diameter
// Of a column of discs, about the overlap at the bottom: what is heavy settles fast.
constexpr std::array weights{1e-3, 1e-4, 1e-5};
constexpr double balance = 1e-3;  // net force / mean overlap
constexpr double never_clear = -1.0;
constexpr int most_relaxing_steps = 500'000;

// Lengths are in Box2D's units, of which it tolerates overlaps of 0.005 and coordinates up to some ten
// thousand.
constexpr double units_per_radius = 10.0;
constexpr double largest_coordinate = 32768.0;
constexpr float gravity = 100.0F;
constexpr float air = 1.0F;  // linear damping: no disc falls faster than gravity / air, 1.7 units in a step
constexpr float time_step = 1.0F / 60.0F;
constexpr int velocity_iterations = 20, position_iterations = 10;
constexpr float at_rest = 1.0F;  // mean speed: less than discs gain in a step of free fall
constexpr int steps_at_rest = 30;
constexpr int most_steps = 20'000;

float single(double value) {
    return static_cast<float>(value);
}

/// Frictionless discs between two walls, above the bottom at y = 0.
class Fall {
  public:
    Fall(const std::vector<double>& radii, const std::vector<Vec2>& center, const Box& box)
        : units_(std::min(units_per_radius, largest_coordinate / std::max(box.width(), box.height()))) {
        world_.SetAllowSleeping(false);
        add_wall({0.0, 0.0}, {box.width(), 0.0}, {0.0, -1.0});
        add_wall({0.0, 0.0}, {0.0, 2.0 * box.height()}, {-1.0, 0.0});
        add_wall({box.width(), 0.0}, {box.width(), 2.0 * box.height()}, {1.0, 0.0});
        discs_.resize(radii.size());
        // Box2D makes a better tree of neighbours one after the other: 100 000 discs found their pairs in
        // 0.2 s, in a random order in 3 to 5.
        for (const int disc : space_order(center, 2.0)) {
            const auto k = static_cast<std::size_t>(disc);
            b2CircleShape circle;
            circle.m_radius = single(units_ * radii[k]);
            b2BodyDef body;
            body.type = b2_dynamicBody;
            body.fixedRotation = true;
            body.linearDamping = air;
            body.position = point(center[k]);
            discs_[k] = world_.CreateBody(&body);
            discs_[k]->CreateFixture(fixture(circle));
            mass_ += discs_[k]->GetMass();
        }
    }

    /// False if the discs do not come to rest.
    bool settle() {
        int resting = 0;
        for (int k = 0; k < most_steps && resting < steps_at_rest; ++k) {
            heed_stop();
            world_.Step(time_step, velocity_iterations, position_iterations);
            const bool rest = momentum() < at_rest * mass_;
            resting = rest ? resting + 1 : 0;
        }
        return resting == steps_at_rest;
    }

    std::vector<Vec2> centers() const {
        std::vector<Vec2> all;
        for (const b2Body* disc : discs_)
            all.push_back(Vec2{disc->GetPosition().x, disc->GetPosition().y} / units_);
        return all;
    }

  private:
    float momentum() const {
        float sum = 0.0F;
        for (const b2Body* disc : discs_) sum += disc->GetMass() * disc->GetLinearVelocity().Length();
        return sum;
    }

    b2Vec2 point(const Vec2& x) const { return {single(units_ * x.x()), single(units_ * x.y())}; }

    static const b2FixtureDef* fixture(const b2Shape& shape) {
        static thread_local b2FixtureDef definition;
        definition.shape = &shape;
        definition.density = 1.0F;
        definition.friction = 0.0F;
        definition.restitution = 0.0F;
        return &definition;
    }

    /// Its surface lies b2_polygonRadius before the edge, and so the edge that much outwards.
    void add_wall(const Vec2& from, const Vec2& to, const Vec2& outwards) {
        const Vec2 back = outwards * static_cast<double>(b2_polygonRadius) / units_;
        b2EdgeShape edge;
        edge.SetTwoSided(point(from + back), point(to + back));
        b2BodyDef body;
        world_.CreateBody(&body)->CreateFixture(fixture(edge));
    }

    double units_;
    b2World world_{b2Vec2(0.0F, -gravity)};
    std::vector<b2Body*> discs_;
    float mass_ = 0.0F;
};

double top_of(const OverlapEnergy& discs) {
    double top = 0.0;
    for (std::size_t k = 0; k < discs.radius().size(); ++k)
        top = std::max(top, discs.center()[k].y() + discs.radius()[k]);
    return top;
}

/// In a box [0, width] of no overlaps, as high as its highest disc or more.
OverlapEnergy fallen(const std::vector<double>& radii, double width, Random& random) {
    const double gas_height = disc_area(radii) / (gas_fraction * width);
    const Packing gas = random_sequential(
        radii, {.aspect_ratio = gas_height / width, .packing_fraction = gas_fraction}, random);
    Fall fall(radii, gas.center, gas.box);
    if (!fall.settle())
        throw InputError("packing: the falling grains did not come to rest, change random.seed");
    OverlapEnergy discs(radii, fall.centers(), gas.box);
    for (const double weight : weights) {
        discs.set_gravity(weight / top_of(discs));
        const auto state = discs.relax(balance, never_clear, most_relaxing_steps);
        if (state.largest_force > balance * state.mean_overlap)
            throw InputError("packing: the fallen grains did not come to rest, change random.seed");
    }
    discs.scale(1.0 + discs.opening());
    return discs;
}

}  // namespace

Packing deposition(const std::vector<double>& radii, const PackingRequest& request, Random& random) {
    const double mean = std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
    std::vector<double> in_means = radii;
    for (double& r : in_means) r /= mean;
    const double least_width = 2.0 * narrowest * *std::max_element(in_means.begin(), in_means.end());

    const double guess =
        std::max(0.5, guess_inside - guess_at_walls / std::sqrt(static_cast<double>(radii.size())));
    double width = std::max(least_width, request.box_for(in_means, guess).width());
    Packing packing{.box = {}, .center = {}, .radius = radii, .frame = {}};
    double least_space = INFINITY;
    for (int k = 0; k < most_falls && least_space > 2.0; ++k) {
        const OverlapEnergy discs = fallen(in_means, width, random);
        const double bottom = discs.box().width(), height = request.aspect_ratio * bottom;
        const double top = top_of(discs);
        if (const double space = height - top; space >= 0.0 && space < least_space) {
            least_space = space;
            packing.box = Box{{0.0, mean * bottom, 0.0, mean * height}};
            packing.center = discs.center();
        }
        // The same area of discs under a lid that leaves the space of a radius, of more if that fails.
        width = std::max(least_width, std::sqrt(bottom * (top + 1.0 + 0.5 * k) / request.aspect_ratio));
    }
    if (packing.center.empty())
        throw InputError(
            "packing: no width was found at which the grains fall just under the lid, change "
            "random.seed or take more grains");
    for (Vec2& c : packing.center) c *= mean;
    return packing;
}

}  // namespace softgrain
