#include "common/packing/make_packing.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "common/errors.hpp"
#include "common/packing/driven_grains.hpp"
#include "common/packing/fill_region.hpp"
#include "common/packing/generators.hpp"
#include "common/packing/grain_classes.hpp"
#include "common/packing/packing_csv.hpp"
#include "common/packing/size_laws.hpp"

namespace softgrain {
namespace {

void scale_to(Packing& packing, double width, double height) {
    const double factor = width / packing.box.width();
    for (Vec2& c : packing.center) c *= factor;
    for (double& r : packing.radius) r *= factor;
    packing.box = Box{{0.0, width, 0.0, height}, packing.box.periodic};
}

Packing from_file(const Scenario& scenario) {
    const BoxSpec& box = scenario.box;
    if (!box.width || !box.height) throw InputError("packing.path needs box.width and box.height");
    const std::filesystem::path& path = *scenario.packing.path;
    Packing packing = read_packing_csv(path, Box{{0.0, *box.width, 0.0, *box.height}, box.periodic},
                                       scenario.class_count(), clump_shapes(scenario));
    if (scenario.has_clumps() && packing.angle.empty())
        throw InputError(
            fmt::format("{}: grain_class.clump needs a column angle in a packing file", path.string()));
    if (scenario.has_ellipses() && packing.aspect_ratio.empty())
        throw InputError(
            fmt::format("{}: grain_class.aspect_ratio needs columns aspect_ratio and angle in a "
                        "packing file",
                        path.string()));
    if (packing.grain_class.empty()) packing.grain_class = draw_classes(scenario, packing.size());
    return packing;
}

Packing generated(const Scenario& scenario) {
    const BoxSpec& box = scenario.box;
    const bool sized = box.width && box.height;
    Random random(scenario.seed);
    Packing shapes;
    shapes.radius = draw_radii(scenario.packing, random);
    const std::size_t n = shapes.radius.size();
    shapes.grain_class = draw_classes(scenario, n);
    shapes.aspect_ratio = aspect_ratios(scenario, shapes.grain_class, n);
    shapes.clumps = clump_shapes(scenario);
    const std::vector<double> elongation = elongations(shapes);
    if (!elongation.empty()) shapes.angle = draw_angles(scenario, n);
    const std::vector<double> around = radii_of_discs_around(shapes.radius, elongation);
    const std::optional<PackingRegion>& region = scenario.packing.region;
    const PackingRequest request{.aspect_ratio = sized ? *box.height / *box.width : 1.0,
                                 .packing_fraction = scenario.packing.packing_fraction,
                                 .periodic = box.periodic,
                                 .grain_share = share_of_discs_around(shapes.radius, elongation)};
    const Packing discs =
        region ? fill_region(around, *region, Box{{0.0, box.width.value(), 0.0, box.height.value()}}, random)
               : generate(scenario.packing.generator, around, request, random);
    Packing packing = std::move(shapes);
    packing.box = discs.box;
    packing.center = discs.center;
    packing.frame = discs.frame;
    if (sized && !region) scale_to(packing, *box.width, *box.height);
    return packing;
}

}  // namespace

Packing make_packing(const Scenario& scenario) {
    Packing packing = scenario.packing.path ? from_file(scenario) : generated(scenario);
    add_driven_grains(scenario, packing);
    return packing;
}

}  // namespace softgrain
