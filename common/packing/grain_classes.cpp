#include "common/packing/grain_classes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/packing/random.hpp"

namespace softgrain {
namespace {

// Any numbers that part the streams from that of the sizes.
constexpr std::uint64_t class_stream = 0x5851F42D4C957F2DU;
constexpr std::uint64_t angle_stream = 0x14057B7EF767814FU;

/// Number of grains of each class: rounded down, the rest to the largest remainders.
std::vector<std::size_t> numbers_of(const std::vector<GrainClass>& classes, std::size_t grains) {
    double all = 0.0;
    for (const GrainClass& c : classes) all += c.share;
    std::vector<std::size_t> number;
    std::vector<double> remainder;
    for (const GrainClass& c : classes) {
        const double exact = c.share / all * static_cast<double>(grains);
        number.push_back(static_cast<std::size_t>(exact));
        remainder.push_back(exact - std::floor(exact));
    }
    std::vector<std::size_t> order(classes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return remainder[a] > remainder[b]; });
    std::size_t placed = std::accumulate(number.begin(), number.end(), std::size_t{0});
    for (std::size_t k = 0; placed < grains; ++k, ++placed) ++number[order[k % order.size()]];
    return number;
}

}  // namespace

std::vector<std::uint8_t> draw_classes(const Scenario& scenario, std::size_t grains) {
    if (scenario.class_count() == 1) return {};
    std::vector<std::uint8_t> classes;
    const auto number = numbers_of(scenario.classes, grains);
    for (std::size_t c = 0; c < number.size(); ++c)
        classes.insert(classes.end(), number[c], static_cast<std::uint8_t>(c));
    classes.resize(grains);  // rounding of shares cannot give more
    Random random(scenario.seed ^ class_stream);
    random.shuffle(classes);
    return classes;
}

std::vector<double> aspect_ratios(const Scenario& scenario, const std::vector<std::uint8_t>& classes,
                                  std::size_t grains) {
    if (!scenario.has_ellipses()) return {};
    std::vector<double> ratios(grains, scenario.classes.front().aspect_ratio);
    for (std::size_t g = 0; g < classes.size(); ++g) ratios[g] = scenario.classes[classes[g]].aspect_ratio;
    return ratios;
}

std::vector<ClumpShape> clump_shapes(const Scenario& scenario) {
    if (!scenario.has_clumps()) return {};
    static const Disc whole{Vec2::Zero(), 1.0};
    std::vector<ClumpShape> shapes;
    for (const GrainClass& c : scenario.classes)
        shapes.push_back(clump_shape(c.clump.empty() ? std::span(&whole, 1) : std::span(c.clump)));
    return shapes;
}

std::vector<double> draw_angles(const Scenario& scenario, std::size_t grains) {
    Random random(scenario.seed ^ angle_stream);
    const double most = (scenario.has_clumps() ? 2.0 : 1.0) * std::numbers::pi;
    std::vector<double> angles(grains);
    std::generate(angles.begin(), angles.end(), [&] { return random.between(0.0, most); });
    return angles;
}

std::vector<double> elongations(const Packing& packing) {
    std::vector<double> elongation = packing.aspect_ratio;
    if (packing.clumps.empty()) return elongation;
    elongation.resize(packing.radius.size(), 1.0);
    for (std::size_t g = 0; g < elongation.size(); ++g) {
        const double reach = packing.clumps[packing.class_of(g)].reach;
        elongation[g] = std::max(elongation[g], reach * reach);
    }
    return elongation;
}

std::vector<double> radii_of_discs_around(const std::vector<double>& radii,
                                          const std::vector<double>& elongation) {
    std::vector<double> around = radii;
    for (std::size_t g = 0; g < elongation.size(); ++g) around[g] *= std::sqrt(elongation[g]);
    return around;
}

double share_of_discs_around(const std::vector<double>& radii, const std::vector<double>& elongation) {
    if (elongation.empty()) return 1.0;
    double grains = 0.0, discs = 0.0;
    for (std::size_t g = 0; g < radii.size(); ++g) {
        grains += radii[g] * radii[g];
        discs += elongation[g] * radii[g] * radii[g];
    }
    return grains / discs;
}

}  // namespace softgrain
