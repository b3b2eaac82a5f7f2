#pragma once
// The rectangular container: four straight, frictionless or frictional walls.
#include <array>
#include <cstddef>
#include <string_view>

#include "common/vec.hpp"

namespace softgrain {

enum class Wall : int { left = 0, right = 1, bottom = 2, top = 3 };
inline constexpr std::array<Wall, 4> all_walls{Wall::left, Wall::right, Wall::bottom, Wall::top};
inline constexpr std::array<std::string_view, 4> wall_names{"left", "right", "bottom", "top"};

/// Axis that the wall's normal lies on: 0 for left and right, 1 for bottom and top.
constexpr int wall_axis(int wall) {
    return wall / 2;
}
/// +1 if the wall's inward normal points along its axis (left, bottom), else -1.
constexpr double wall_sign(int wall) {
    return wall % 2 == 0 ? 1.0 : -1.0;
}
/// Inward unit normal.
inline Vec2 wall_normal(int wall) {
    return wall_axis(wall) == 0 ? Vec2{wall_sign(wall), 0.0} : Vec2{0.0, wall_sign(wall)};
}

/// Wall coordinates [m] in the order left, right, bottom, top.
struct Box {
    std::array<double, 4> position{0.0, 1.0, 0.0, 1.0};

    double width() const { return position[1] - position[0]; }
    double height() const { return position[3] - position[2]; }
    double area() const { return width() * height(); }
    /// Distance of a point from a wall, positive inside [m].
    double distance(int wall, const Vec2& x) const {
        const auto w = static_cast<std::size_t>(wall);
        return wall_sign(wall) * (x[wall_axis(wall)] - position[w]);
    }
};

/// Box at the start of a step and the velocity of each wall during it [m], [m/s].
struct WallMotion {
    Box box;
    std::array<double, 4> velocity{};

    Box after(double dt) const {
        Box moved = box;
        for (std::size_t w = 0; w < 4; ++w) moved.position[w] += velocity[w] * dt;
        return moved;
    }
    Vec2 velocity_of(int wall) const {
        const double v = velocity[static_cast<std::size_t>(wall)];
        return wall_axis(wall) == 0 ? Vec2{v, 0.0} : Vec2{0.0, v};
    }
};

}  // namespace softgrain
