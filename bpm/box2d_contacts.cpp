#include "bpm/box2d_contacts.hpp"

#include <box2d/box2d.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "common/at.hpp"
#include "common/errors.hpp"
#include "common/neighbors.hpp"

namespace softgrain::bpm {
namespace {

// Here coordinates are rounded to 0.002 units: less than the slop.
constexpr double largest_coordinate = 32768.0;
constexpr double wall_half_thickness = 2.0;  // [mean disc diameters]

float single(double value) {
    return static_cast<float>(value);
}

int index_of(const b2Body& body) {
    return static_cast<int>(const_cast<b2Body&>(body).GetUserData().pointer);
}

}  // namespace

/// Bodies are numbered: the discs, then the walls.
struct Box2dContacts::World {
    /// Discs of one grain do not rub.
    class NoFrictionWithin final : public b2ContactListener {
      public:
        explicit NoFrictionWithin(std::span<const int> group) : group_(group.begin(), group.end()) {}
        void BeginContact(b2Contact* contact) override {
            const std::size_t a = at(index_of(*contact->GetFixtureA()->GetBody()));
            const std::size_t b = at(index_of(*contact->GetFixtureB()->GetBody()));
            if (a < group_.size() && b < group_.size() && group_[a] == group_[b]) contact->SetFriction(0.0F);
        }

      private:
        std::vector<int> group_;
    };

    explicit World(const Discs& discs) : listener(discs.group) {
        b2.SetAllowSleeping(false);
        b2.SetContinuousPhysics(false);
        b2.SetSubStepping(false);
        b2.SetWarmStarting(true);
        b2.SetContactListener(&listener);
    }

    b2Body* add(b2BodyType type, const b2Vec2& position, std::size_t index) {
        b2BodyDef body;
        body.type = type;
        body.position = position;
        body.allowSleep = false;
        body.userData.pointer = index;
        return b2.CreateBody(&body);
    }

    NoFrictionWithin listener;
    b2World b2{b2Vec2(0.0F, 0.0F)};
    std::vector<b2Body*> disc;
    std::array<b2Body*, 4> wall{};
};

Box2dContacts::Box2dContacts(const Box2dSettings& settings, const Discs& discs, const Box& box)
    : settings_(settings),
      origin_(0.5 * (box.position[0] + box.position[1]), 0.5 * (box.position[2] + box.position[3])),
      length_(settings.diameter / settings.units),
      speed_(length_ / settings.time),
      world_(std::make_unique<World>(discs)) {
    const double extent = std::max(box.width(), box.height()) / length_;
    if (0.5 * extent > largest_coordinate)
        throw InputError(fmt::format(
            "bpm: the box is {:.0f} disc diameters wide, too many for the single precision of "
            "engine = \"box2d\" (at most {:.0f}); use fewer grains, a larger bpm.step, or engine = \"nscd\"",
            extent / settings.units, 2.0 * largest_coordinate / settings.units));
    b2FixtureDef fixture;
    fixture.restitution = 0.0F;
    fixture.friction = single(settings.friction);
    for (std::size_t d = 0; d < discs.x.size(); ++d) {
        const Vec2 x = (discs.x[d] - origin_) / length_;
        b2CircleShape circle;
        circle.m_radius = single(discs.radius[d] / length_);
        fixture.shape = &circle;
        fixture.density = single(discs.mass[d] / settings.mass) / (b2_pi * circle.m_radius * circle.m_radius);
        world_->disc.push_back(world_->add(b2_dynamicBody, {single(x.x()), single(x.y())}, d));
        world_->disc.back()->CreateFixture(&fixture);
    }
    fixture.friction = 0.0F;
    fixture.density = 0.0F;
    for (int w = 0; w < 4; ++w) {
        const float half_length = single(2.0 * extent);
        const float half_thickness = single(wall_half_thickness * settings.units);
        b2PolygonShape plate;
        plate.SetAsBox(wall_axis(w) == 0 ? half_thickness : half_length,
                       wall_axis(w) == 0 ? half_length : half_thickness);
        fixture.shape = &plate;
        world_->wall[at(w)] = world_->add(b2_kinematicBody, {0.0F, 0.0F}, discs.x.size() + at(w));
        world_->wall[at(w)]->CreateFixture(&fixture);
    }
    place_walls({box, {}});
}

Box2dContacts::~Box2dContacts() = default;

double Box2dContacts::largest_move() const {
    constexpr double rounding = 1e-5;
    return (1.0 - rounding) * static_cast<double>(b2_maxTranslation) * length_;
}

/// The surface of a plate lies b2_polygonRadius outside of its shape.
void Box2dContacts::place_walls(const WallMotion& walls) {
    for (int w = 0; w < 4; ++w) {
        const int axis = wall_axis(w);
        const double surface = (walls.box.position[at(w)] - origin_[axis]) / length_;
        const double back = wall_half_thickness * settings_.units + static_cast<double>(b2_polygonRadius);
        Vec2 middle = Vec2::Zero();
        middle[axis] = surface - wall_sign(w) * back;
        const Vec2 v = walls.velocity_of(w) / speed_;
        world_->wall[at(w)]->SetTransform({single(middle.x()), single(middle.y())}, 0.0F);
        world_->wall[at(w)]->SetLinearVelocity({single(v.x()), single(v.y())});
    }
}

ContactResult Box2dContacts::solve(const Discs& discs, const WallMotion& walls, double h, std::span<Vec2> x) {
    const bool turning = !discs.rim_speed.empty();
    for (std::size_t d = 0; d < world_->disc.size(); ++d) {
        const Vec2 v = discs.v[d] / speed_;
        world_->disc[d]->SetLinearVelocity({single(v.x()), single(v.y())});
        if (turning)
            world_->disc[d]->SetAngularVelocity(
                single(discs.rim_speed[d] / discs.radius[d] * settings_.time));
    }
    place_walls(walls);
    world_->b2.Step(single(h / settings_.time), settings_.velocity_iterations, settings_.position_iterations);

    const double penetration = read_contacts(discs, walls.box);
    for (std::size_t d = 0; d < world_->disc.size(); ++d) {
        const b2Vec2& position = world_->disc[d]->GetPosition();
        const b2Vec2& velocity = world_->disc[d]->GetLinearVelocity();
        x[d] = origin_ + length_ * Vec2(position.x, position.y);
        discs.v[d] = speed_ * Vec2(velocity.x, velocity.y);
        if (turning)
            discs.rim_speed[d] =
                static_cast<double>(world_->disc[d]->GetAngularVelocity()) * discs.radius[d] / settings_.time;
    }
    return {.iterations = settings_.velocity_iterations,
            .sweeps = static_cast<double>(settings_.velocity_iterations),
            .residual = 0.0,
            .penetration = penetration,
            .converged = true};
}

void Box2dContacts::add_row(const Discs& discs, int i, int j, double normal, double tangential) {
    rows_.i.push_back(i);
    rows_.j.push_back(j);
    rows_.direction.push_back((discs.x[at(j)] - discs.x[at(i)]).normalized());
    rows_.share.push_back(discs.mass[at(j)] / (discs.mass[at(i)] + discs.mass[at(j)]));
    rows_.normal.push_back(normal);
    rows_.tangential.push_back(tangential);
}

/// Returns the deepest overlap; discs.x are the positions before the step.
double Box2dContacts::read_contacts(const Discs& discs, const Box& box) {
    rows_ = {};
    wall_rows_ = {};
    const int count = static_cast<int>(discs.x.size());
    double deepest = 0.0;
    for (const b2Contact* contact = world_->b2.GetContactList(); contact; contact = contact->GetNext()) {
        if (!contact->IsTouching()) continue;
        const auto [i, j] = std::minmax(
            {index_of(*contact->GetFixtureA()->GetBody()), index_of(*contact->GetFixtureB()->GetBody())});
        const b2ManifoldPoint& point = contact->GetManifold()->points[0];
        const double normal = settings_.mass * speed_ * static_cast<double>(point.normalImpulse);
        if (j >= count) {
            const int wall = j - count;
            wall_rows_.disc.push_back(i);
            wall_rows_.wall.push_back(wall);
            wall_rows_.normal.push_back(normal / discs.mass[at(i)]);
            deepest = std::max(deepest, discs.radius[at(i)] - box.distance(wall, discs.x[at(i)]));
            continue;
        }
        const double reduced =
            discs.mass[at(i)] * discs.mass[at(j)] / (discs.mass[at(i)] + discs.mass[at(j)]);
        // Box2D's tangent is its normal turned by -90 degrees.
        const double tangential = -settings_.mass * speed_ * static_cast<double>(point.tangentImpulse);
        add_row(discs, i, j, normal / reduced, tangential / reduced);
        deepest = std::max(
            deepest, discs.radius[at(i)] + discs.radius[at(j)] - (discs.x[at(j)] - discs.x[at(i)]).norm());
    }
    return deepest;
}

void Box2dContacts::add_near(const Discs& discs, const Box& box, double gap) {
    std::vector<Pair> listed;
    for (std::size_t k = 0; k < rows_.i.size(); ++k) listed.push_back({rows_.i[k], rows_.j[k]});
    std::sort(listed.begin(), listed.end());
    NeighborList near;
    near.build(discs.x, discs.radius, gap);
    for (const Pair& pair : near.pairs())
        if (!std::binary_search(listed.begin(), listed.end(), pair)) add_row(discs, pair.i, pair.j, 0.0, 0.0);

    std::vector<std::pair<int, int>> at_wall;
    for (std::size_t k = 0; k < wall_rows_.size(); ++k)
        at_wall.emplace_back(wall_rows_.disc[k], wall_rows_.wall[k]);
    std::sort(at_wall.begin(), at_wall.end());
    for (int d = 0; d < static_cast<int>(discs.x.size()); ++d)
        for (int wall = 0; wall < 4; ++wall) {
            if (box.distance(wall, discs.x[at(d)]) >= discs.radius[at(d)] + gap) continue;
            if (std::binary_search(at_wall.begin(), at_wall.end(), std::pair(d, wall))) continue;
            wall_rows_.disc.push_back(d);
            wall_rows_.wall.push_back(wall);
            wall_rows_.normal.push_back(0.0);
        }
}

}  // namespace softgrain::bpm
