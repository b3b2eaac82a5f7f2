#pragma once
// The container: four straight walls, or a periodic cell without walls that may be sheared.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

/// Which copy of a periodic cell: x times the first lattice vector and y times the second.
struct Image {
    std::int8_t x = 0, y = 0;

    Image operator-() const { return {static_cast<std::int8_t>(-x), static_cast<std::int8_t>(-y)}; }
    friend bool operator==(const Image&, const Image&) = default;
};

/// Wall coordinates [m] in the order left, right, bottom, top. If it is periodic these are the faces of a
/// cell with the lattice vectors (width, 0) and (tilt, height), its origin at (left, bottom).
struct Box {
    std::array<double, 4> position{0.0, 1.0, 0.0, 1.0};
    bool periodic = false;
    double tilt = 0.0;  ///< x offset of the top edge against the bottom, periodic only [m]

    double width() const { return position[1] - position[0]; }
    double height() const { return position[3] - position[2]; }
    double area() const { return width() * height(); }
    Vec2 origin() const { return {position[0], position[2]}; }
    /// Distance of a point from a wall, positive inside [m].
    double distance(int wall, const Vec2& x) const {
        const auto w = static_cast<std::size_t>(wall);
        return wall_sign(wall) * (x[wall_axis(wall)] - position[w]);
    }

    // Periodic cell. Any tilt is allowed in what follows.
    /// Offset of a copy of the cell [m].
    Vec2 image(int ix, int iy) const { return {ix * width() + iy * tilt, iy * height()}; }
    Vec2 image(Image i) const { return image(i.x, i.y); }
    /// The lattice vectors as columns [m].
    Mat2 lattice() const { return (Mat2() << width(), tilt, 0.0, height()).finished(); }
    /// Tilt as a share of the height: the shear strain of a cell that began as a rectangle.
    double shear_strain() const { return tilt / height(); }
    /// The copy that x lies in: x - image(image_of(x)) lies in the cell. At most 127 cells away.
    Image image_of(const Vec2& x) const;
    Vec2 wrapped(const Vec2& x) const { return x - image(image_of(x)); }
    /// The copy that brings the difference d of two positions nearest to zero: d + image(nearest_image(d)).
    /// Sure for distances below half of the smaller spacing().
    Image nearest_image(const Vec2& d) const;
    Vec2 nearest(const Vec2& d) const { return d + image(nearest_image(d)); }
    /// Smaller distance between opposite faces of the cell, at right angles to them [m].
    double spacing() const { return std::min(height(), width() / std::hypot(1.0, shear_strain())); }

    /// The same lattice by its second vector less `flips` times the first.
    Box flipped(int flips) const {
        Box other = *this;
        other.tilt -= flips * width();
        return other;
    }
    /// Flips that leave a tilt of at most half the width.
    int flips() const { return static_cast<int>(std::lround(tilt / width())); }
    Box reduced() const { return flipped(flips()); }
};

/// Box at the start of a step and the velocity of each wall during it [m], [m/s].
struct WallMotion {
    Box box;
    std::array<double, 4> velocity{};
    double tilt_rate = 0.0;  ///< [m/s]

    Box after(double dt) const {
        Box moved = box;
        for (std::size_t w = 0; w < 4; ++w) moved.position[w] += velocity[w] * dt;
        moved.tilt += tilt_rate * dt;
        return moved;
    }
    Vec2 velocity_of(int wall) const {
        const double v = velocity[static_cast<std::size_t>(wall)];
        return wall_axis(wall) == 0 ? Vec2{v, 0.0} : Vec2{0.0, v};
    }

    double width_rate() const { return velocity[1] - velocity[0]; }
    double height_rate() const { return velocity[3] - velocity[2]; }
    /// Velocity of box.image(ix, iy) [m/s].
    Vec2 image_velocity(int ix, int iy) const {
        return {ix * width_rate() + iy * tilt_rate, iy * height_rate()};
    }
    Vec2 image_velocity(Image i) const { return image_velocity(i.x, i.y); }
    /// L of the flow v = L x that carries the lattice along, upper triangular [1/s]. For wall velocities that
    /// stay as they are dL/dt = -L^2: a grain that follows the flow needs no force.
    Mat2 velocity_gradient() const {
        const double xx = width_rate() / box.width();
        return (Mat2() << xx, (tilt_rate - xx * box.tilt) / box.height(), 0.0, height_rate() / box.height())
            .finished();
    }
    /// Velocity of the flow that carries the cell along, its origin included [m/s].
    Vec2 affine_velocity(const Vec2& x) const {
        return Vec2{velocity[0], velocity[2]} + velocity_gradient() * (x - box.origin());
    }
    /// The same motion of the same lattice, see Box::flipped.
    WallMotion flipped(int flips) const {
        return {box.flipped(flips), velocity, tilt_rate - flips * width_rate()};
    }
};

namespace detail {
/// Safe for any number, not a number included.
inline std::int8_t image_count(double n) {
    return static_cast<std::int8_t>(std::max(-127.0, std::min(127.0, n)));
}
}  // namespace detail

inline Image Box::image_of(const Vec2& x) const {
    const Vec2 d = x - origin();
    const double iy = std::floor(d.y() / height());
    return {detail::image_count(std::floor((d.x() - tilt * (d.y() / height())) / width())),
            detail::image_count(iy)};
}

inline Image Box::nearest_image(const Vec2& d) const {
    const double iy = -std::round(d.y() / height());
    return {detail::image_count(-std::round((d.x() + iy * tilt) / width())), detail::image_count(iy)};
}

}  // namespace softgrain
