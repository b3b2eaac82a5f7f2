#include "hand_made_grains.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "common/observables/shape.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {

constexpr double density = 2.0;
constexpr int corners = 40;

/// A fixed number between 0 and 1 for each index.
double scatter(int index) {
    const double x = std::sin(12.9898 * (index + 1)) * 43758.5453;
    return x - std::floor(x);
}

}  // namespace

HandMadeGrains::HandMadeGrains(int n, double strain, double when) : time(when) {
    const double side = 1.0 - strain;
    box.position = {strain / 2.0, 1.0 - strain / 2.0, strain / 2.0, 1.0 - strain / 2.0};
    outline_offset.push_back(0);
    const double level = 0.02 * strain / 0.2;
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
            add_grain(row, column, side / n);
            const double p = level * (0.3 + 1.4 * scatter(row * n + column));
            const double q = 0.3 * p * (scatter(row + n * column) - 0.5);
            stress.push_back((Mat2() << p + q, 0.1 * p, 0.1 * p, p - q).finished());
            temperature.push_back(static_cast<double>(row * n + column));
            for (const double component : {1.0 - strain, 0.02, -0.01, 1.0 - strain})
                stretch.push_back(component);
        }
    add_contacts(n);
    for (int wall = 0; wall < 4; ++wall)
        wall_force[static_cast<std::size_t>(wall)] = -level * side * (1.0 + 0.1 * wall) * wall_normal(wall);
}

void HandMadeGrains::add_grain(int row, int column, double spacing) {
    const int index = static_cast<int>(centroid.size());
    const Vec2 middle = Vec2{box.position[0], box.position[2]} + spacing * Vec2{column + 0.5, row + 0.5};
    centroid.push_back(middle);
    velocity.push_back(0.01 * (Vec2{0.5, 0.5} - middle));
    const double roundness = 2.0 + 20.0 * (1.0 - box.width());
    const std::size_t first = outline_point.size();
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / corners;
        const double c = std::abs(std::cos(angle)), s = std::abs(std::sin(angle));
        double radius =
            0.5 * spacing / std::pow(std::pow(c, roundness) + std::pow(s, roundness), 1.0 / roundness);
        if (index % 4 == 3) radius *= 1.0 - 0.15 * std::pow(std::sin(2.5 * angle), 2);
        outline_point.push_back(middle + radius * Vec2{std::cos(angle), std::sin(angle)});
    }
    outline_offset.push_back(static_cast<int>(outline_point.size()));
    area.push_back(polygon_shape(std::span(outline_point).subspan(first)).area);
    reference_area.push_back(1.05 * area.back());
    mass.push_back(density * reference_area.back());
}

void HandMadeGrains::add_contacts(int n) {
    const double level = 0.02 * (1.0 - box.width()) / 0.2 * box.width() / n;
    const auto add = [&](int i, int j, const Vec2& normal) {
        const double force = level * (0.1 + 1.8 * scatter(7 * i + 3 * j + 100));
        const Vec2 point = centroid[static_cast<std::size_t>(i)] + 0.5 * box.width() / n * normal;
        const Vec2 on_i = -force * normal + 0.05 * force * perpendicular(normal);
        contacts.push_back({i, j, point, normal, on_i, 0.1 * box.width() / n});
    };
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
            const int i = row * n + column;
            if (row == n - 1) add(i, -4, {0.0, 1.0});
            if (row == 0) add(i, -3, {0.0, -1.0});
            if (column == n - 1) add(i, -2, {1.0, 0.0});
            if (column == 0) add(i, -1, {-1.0, 0.0});
            if (column + 1 < n) add(i, i + 1, {1.0, 0.0});
            if (row + 1 < n) add(i, i + n, {0.0, 1.0});
        }
}

GrainView HandMadeGrains::view() const {
    GrainView view;
    view.time = time;
    view.box = box;
    view.centroid = centroid;
    view.velocity = velocity;
    view.mass = mass;
    view.reference_area = reference_area;
    view.wall_force = wall_force;
    view.area = area;
    view.covered_area = packing_fraction() * box.area();
    view.contacts = contacts;
    view.stress = stress;
    view.outline_offset = outline_offset;
    view.outline_point = outline_point;
    view.fields = {{"temperature", "K", 1, temperature}, {"stretch", "", 4, stretch}};
    return view;
}

double HandMadeGrains::packing_fraction() const {
    double covered = 0.0;
    for (const double a : area) covered += a;
    return covered / box.area();
}

double HandMadeGrains::mean_stress() const {
    double sum = 0.0;
    for (const Mat2& s : stress) sum += s.trace() / 2.0;
    return sum / static_cast<double>(stress.size());
}

HandMadeParts::HandMadeParts(const HandMadeGrains& grains) {
    for (std::size_t g = 0; g < grains.centroid.size(); ++g)
        for (int k = 0; k < per_grain; ++k) {
            const double size = std::sqrt(grains.area[g]) / 4.0;
            const Vec2 aside{k % 2 == 0 ? -size : size, k < 2 ? -size : size};
            position.push_back(grains.centroid[g] + aside);
            reference.push_back(0.9 * position.back());
            radius.push_back(size);
            velocity.insert(velocity.end(), {0.1 * k, -0.2 * static_cast<double>(g)});
            heat.push_back(scatter(static_cast<int>(position.size())));
            grain.push_back(static_cast<int>(g));
        }
    const auto reach = [&](std::size_t i, std::size_t j) { return 1.15 * (radius[i] + radius[j]); };
    for (std::size_t i = 0; i < position.size(); ++i) {
        const int first = static_cast<int>(i);
        for (int wall = 3; wall >= 0; --wall)
            if (grains.box.distance(wall, position[i]) < 1.3 * radius[i])
                contacts.push_back({first, -1 - wall, 0.5 + heat[i], 0.0});
        for (std::size_t j = i + 1; j < position.size(); ++j)
            if ((position[j] - position[i]).norm() < reach(i, j))
                contacts.push_back({first, static_cast<int>(j), 0.1 + heat[i], 0.1 * heat[j]});
    }
}

PartView HandMadeParts::view() const {
    PartView view;
    view.position = position;
    view.reference = reference;
    view.radius = radius;
    view.grain = grain;
    view.contacts = contacts;
    view.fields = {{"velocity", "m/s", 2, velocity}, {"heat", "J", 1, heat}};
    return view;
}

Sample frame_sample(int frame) {
    Sample sample;
    sample.index = 2 * frame;
    sample.is_frame = true;
    sample.frame = frame;
    return sample;
}

void write_hand_made_run(const std::filesystem::path& directory, int n, int frames, double strain) {
    GrainWriter grains(directory, Need::all);
    ContactWriter contacts(directory);
    WallWriter walls(directory);
    std::filesystem::create_directories(directory);
    std::ofstream history(directory / "history.csv");
    history << "time,step,axial_strain,packing_fraction,mean_stress,coordination_number\n";
    for (int k = 0; k < 2 * frames - 1; ++k) {
        const double so_far = strain * k / std::max(1, 2 * frames - 2);
        const HandMadeGrains state(n, so_far, 10.0 * k);
        history << fmt::format("{},{},{},{},{},{}\n", state.time, 100 * k, so_far, state.packing_fraction(),
                               state.mean_stress(), 4.0 * (1.0 - 1.0 / n));
        if (k % 2 != 0) continue;
        for (Observer* writer : std::initializer_list<Observer*>{&grains, &contacts, &walls})
            writer->observe(state.view(), frame_sample(k / 2));
    }
}

TemporaryFolder::TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "softgrain-viz-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace softgrain
