// Time per contact of the chord: one by one, batched for each instruction set, and the paper's polygons.
// Pairs slide and approach by about 1e-4 R from one call to the next. Usage: chord_speed [milliseconds]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <random>
#include <vector>

#include "sdem/geometry/chord.hpp"
#include "sdem/geometry/chord_variants.hpp"
#include "sdem/geometry/polygon_reference.hpp"
#include "tests/sdem/chord_lanes.hpp"

namespace softgrain::sdem {
namespace {

constexpr int contacts = ChordBatch::capacity;

struct Scene {
    std::vector<Ellipse> a, b;
    std::vector<Vec2> step;

    /// Pairs 1e-3 to 0.2 deep, or as far apart if `sign` is -1.
    explicit Scene(double sign) {
        std::mt19937_64 random(1);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        const auto F = [&] {
            Mat2 m = Mat2::Identity();
            for (int k = 0; k < 4; ++k) m(k / 2, k % 2) += 0.2 * (2.0 * unit(random) - 1.0);
            return m;
        };
        for (int k = 0; k < contacts; ++k) {
            a.push_back(make_ellipse(Vec2{unit(random), unit(random)}, F(), 1.0));
            const double R = 0.5 + 0.5 * unit(random);
            const Mat2 F_b = F();
            const double angle = 6.28 * unit(random), depth = std::pow(10.0, -3.0 + 2.3 * unit(random));
            const Vec2 n{std::cos(angle), std::sin(angle)};
            const auto reach = [&](const Mat2& m) { return Vec2{m * (m.transpose() * n).normalized()}; };
            const Vec2 touch = a.back().center + reach(a.back().axes) + R * reach(F_b);
            b.push_back(make_ellipse(touch - sign * depth * n, F_b, R));
            const double turn = 6.28 * unit(random);
            step.push_back(1e-4 * Vec2{std::cos(turn), std::sin(turn)});
        }
    }
    void move(double sign) {
        for (int k = 0; k < contacts; ++k) b[k].center += sign * step[k];
    }
};

ChordBatch batch_of(const Scene& scene) {
    ChordBatch batch;
    batch.count = contacts;
    for (int k = 0; k < contacts; ++k) {
        const Ellipse &a = scene.a[k], &b = scene.b[k];
        WarmStart warm;
        chord_of(a, b, warm);
        test::set_lane(batch, k, a, b, warm);
    }
    return batch;
}

/// Median over repeats of the time of one call of `pass`, in ns per contact.
template <class Pass>
double nanoseconds(const Pass& pass, double milliseconds) {
    using Clock = std::chrono::steady_clock;
    const auto seconds = [](auto duration) { return std::chrono::duration<double>(duration).count(); };
    std::vector<double> times;
    const auto start = Clock::now();
    int calls = 2;  // there and back
    while (seconds(Clock::now() - start) < 1e-3 * milliseconds || times.size() < 5) {
        const auto before = Clock::now();
        for (int k = 0; k < calls; ++k) pass(k % 2 == 0 ? 1.0 : -1.0);
        const double time = seconds(Clock::now() - before);
        if (time < 2e-4)
            calls *= 2;
        else
            times.push_back(1e9 * time / calls / contacts);
    }
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    return times[times.size() / 2];
}

double batch_time(const Scene& scene, void (*solve)(ChordBatch&), double milliseconds) {
    ChordBatch batch = batch_of(scene);
    const double time = nanoseconds(
        [&](double sign) {
            for (int k = 0; k < contacts; ++k) {
                batch.dx[k] += sign * scene.step[k].x();
                batch.dy[k] += sign * scene.step[k].y();
            }
            solve(batch);
        },
        milliseconds);
    const auto sound = std::count(batch.sound, batch.sound + contacts, 1.0);
    if (sound != contacts) fmt::print("  {} of {} lanes were not sound\n", contacts - sound, contacts);
    return time;
}

void measure(double milliseconds) {
    Scene scene(1.0), apart(-1.0);
    fmt::print("{:<28}{:>10}\n", "method", "ns/contact");
    const auto report = [](const char* name, double time) { fmt::print("{:<28}{:>10.2f}\n", name, time); };

    double sum = 0.0;  // used below, so that no call is optimised away
    report("polygons of 360 nodes", nanoseconds(
                                        [&](double sign) {
                                            scene.move(sign);
                                            for (int k = 0; k < contacts; ++k)
                                                sum += polygon_chord(scene.a[k], scene.b[k]).length;
                                        },
                                        milliseconds));
    std::vector<WarmStart> warm(contacts);
    report("chord_of", nanoseconds(
                           [&](double sign) {
                               scene.move(sign);
                               for (int k = 0; k < contacts; ++k)
                                   sum += chord_of(scene.a[k], scene.b[k], warm[k]).length;
                           },
                           milliseconds));
    std::vector<WarmStart> deepest(contacts);
    report("chord_of, apart", nanoseconds(
                                  [&](double sign) {
                                      apart.move(sign);
                                      for (int k = 0; k < contacts; ++k)
                                          sum += chord_of(apart.a[k], apart.b[k], deepest[k]).length;
                                  },
                                  milliseconds));
    report("solve_chords", batch_time(scene, solve_chords, milliseconds));
    for (const ChordVariant& variant : chord_variants())
        if (variant.runs) report(variant.name, batch_time(scene, variant.solve, milliseconds));
    if (!(sum > 0.0)) fmt::print("no chord was found\n");
}

}  // namespace
}  // namespace softgrain::sdem

int main(int argc, char** argv) {
    softgrain::sdem::measure(argc > 1 ? std::atof(argv[1]) : 300.0);
}
