#include "common/packing/make_packing.hpp"

#include "common/errors.hpp"
#include "common/packing/jam.hpp"
#include "common/packing/packing_csv.hpp"
#include "common/packing/size_laws.hpp"

namespace softgrain {
namespace {

void scale_to(Packing& packing, double width, double height) {
    const double factor = width / packing.box.width();
    for (Vec2& c : packing.center) c *= factor;
    for (double& r : packing.radius) r *= factor;
    packing.box = Box{{0.0, width, 0.0, height}};
}

}  // namespace

Packing make_packing(const Scenario& scenario) {
    const BoxSpec& box = scenario.box;
    const bool sized = box.width && box.height;
    if (scenario.packing.path) {
        if (!sized) throw InputError("packing.path needs box.width and box.height");
        return read_packing_csv(*scenario.packing.path, Box{{0.0, *box.width, 0.0, *box.height}});
    }
    Random random(scenario.seed);
    const std::vector<double> radii = draw_radii(scenario.packing, random);
    const double aspect_ratio = sized ? *box.height / *box.width : 1.0;
    Packing packing = jam(radii, aspect_ratio, random, scenario.packing.packing_fraction).packing;
    if (sized) scale_to(packing, *box.width, *box.height);
    return packing;
}

}  // namespace softgrain
