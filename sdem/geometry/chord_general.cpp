// The careful way to the chord, for strongly deformed or badly placed ellipses.
#include <array>
#include <numbers>

#include "sdem/geometry/chord.hpp"

namespace softgrain::sdem::detail {
namespace {

Unit at(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

/// Zero of f between low and high, where its signs differ.
template <class Function>
double bisect(const Function& f, double low, double high) {
    const bool low_negative = f(low) < 0.0;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        ((f(middle) < 0.0) == low_negative ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Angles of the minima and maxima of g in increasing order; 0, 2 or 4 of them.
struct Extrema {
    std::array<double, 8> angle{};
    std::size_t count = 0;
};
Extrema extrema_of(const Level& g) {
    constexpr int samples = 256;
    constexpr double step = 2.0 * std::numbers::pi / samples;
    const auto slope = [&](double angle) { return g.slope(at(angle)); };
    Extrema found;
    // Half a step off the axes, so that the stationary points of aligned ellipses fall between samples.
    double before = slope(-0.5 * step);
    for (int k = 0; k < samples && found.count < found.angle.size(); ++k) {
        const double after = slope((k + 0.5) * step);
        if ((before < 0.0) != (after < 0.0))
            found.angle[found.count++] = bisect(slope, (k - 0.5) * step, (k + 0.5) * step);
        before = after;
    }
    return found;
}

}  // namespace

Chord general_chord(const Level& g, const Ellipse& i, const Ellipse& j, WarmStart& warm) {
    constexpr double tiny = 1e-12;
    warm = WarmStart{};
    if (g.dx * g.dx + g.dy * g.dy < tiny * tiny) return Chord{Overlap::coincident};

    const auto value = [&](double angle) { return g.value(at(angle)); };
    const Extrema extrema = extrema_of(g);
    std::size_t best = extrema.count;
    for (std::size_t k = 0; k < extrema.count; ++k)
        if (best == extrema.count || value(extrema.angle[k]) < value(extrema.angle[best])) best = k;
    if (best == extrema.count) return Chord{Overlap::coincident};
    const double lowest = extrema.angle[best];
    if (value(lowest) >= 0.0) return inside(i, j) ? Chord{Overlap::contained} : Chord{};

    // Walk from the deepest point to the first extremum outside i on either side.
    int crossings = 0;
    for (std::size_t k = 0; k < extrema.count; ++k) {
        const double next = extrema.angle[(k + 1) % extrema.count];
        if ((value(extrema.angle[k]) < 0.0) != (value(next) < 0.0)) ++crossings;
    }
    if (crossings == 0) return Chord{Overlap::contained};
    const auto outside = [&](int direction) {
        for (int hop = 1;; ++hop) {
            const int n = static_cast<int>(extrema.count);
            const int k = static_cast<int>(best) + direction * hop;
            const int wrapped = ((k % n) + n) % n;
            const double turns = static_cast<double>((k - wrapped) / n);
            const double angle =
                extrema.angle[static_cast<std::size_t>(wrapped)] + turns * 2.0 * std::numbers::pi;
            if (value(angle) >= 0.0) return angle;
        }
    };
    const Unit u = at(lowest);
    warm = {u.vec(), u.vec()};
    const Unit a = at(bisect(value, lowest, outside(-1)));
    const Unit b = at(bisect(value, lowest, outside(+1)));
    return finish(g, i, j, a, b, crossings > 2 ? Overlap::four_points : Overlap::chord);
}

}  // namespace softgrain::sdem::detail
