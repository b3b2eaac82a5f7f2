#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "common/errors.hpp"
#include "common/refusals.hpp"

namespace softgrain {
namespace {

std::string refusal(const Scenario& scenario, const Packing& packing, Feature feature) {
    try {
        refuse(scenario, packing, "cubes", std::array{Refusal{feature, "they are stiff"}});
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(Refusals, NameWhatIsAskedAndTheCure) {
    Scenario s;
    Packing p;
    p.center = {{0.5, 0.5}};
    p.radius = {0.1};
    for (const Feature feature : {Feature::periodic_cell, Feature::grain_classes, Feature::ellipses,
                                  Feature::clumps, Feature::friction, Feature::wall_friction,
                                  Feature::cohesion, Feature::yield_stress, Feature::driven_grains})
        EXPECT_EQ(refusal(s, p, feature), "");

    s.material.friction = 0.3;
    EXPECT_EQ(
        refusal(s, p, Feature::friction),
        "material.friction = 0.3 is not for cubes: they are stiff; set material.friction = 0 or run another "
        "method");
    EXPECT_EQ(refusal(s, p, Feature::wall_friction), "");
    s.material.wall_friction = 0.1;
    s.material.cohesion = 2.0;
    EXPECT_NE(refusal(s, p, Feature::wall_friction).find("material.wall_friction = 0.1 is not"),
              std::string::npos);
    EXPECT_NE(refusal(s, p, Feature::cohesion).find("set material.cohesion = 0 or"), std::string::npos);
    p.driven.resize(1);
    EXPECT_EQ(refusal(s, p, Feature::driven_grains),
              "[[driven]] is not for cubes: they are stiff; leave it out or run another method");
    p.driven.clear();
    p.box.periodic = true;
    EXPECT_EQ(refusal(s, p, Feature::periodic_cell),
              "box.periodic = true is not for cubes: they are stiff; set box.periodic = false or run another "
              "method");
    p.aspect_ratio = {1.0};
    p.angle = {0.0};
    EXPECT_EQ(refusal(s, p, Feature::ellipses), "");
    p.aspect_ratio = {1.5};
    EXPECT_NE(refusal(s, p, Feature::ellipses).find("a packing of ellipses is not for cubes"),
              std::string::npos);
    EXPECT_EQ(refusal(s, p, Feature::clumps), "");
    p.clumps.push_back(clump_shape(discs_in_line(2, 1.5)));
    EXPECT_EQ(refusal(s, p, Feature::clumps),
              "a packing of clumps is not for cubes: they are stiff; leave out grain_class.clump and "
              "clump_discs or "
              "run another method");
    s.classes.resize(1);
    EXPECT_EQ(refusal(s, p, Feature::grain_classes), "");
    s.classes.resize(3);
    s.classes[2].material.yield_stress = 0.4;
    EXPECT_NE(refusal(s, p, Feature::grain_classes).find("a scenario of 3 grain classes is not"),
              std::string::npos);
    EXPECT_NE(refusal(s, p, Feature::yield_stress).find("grain_class.2.yield_stress = 0.4 is not"),
              std::string::npos);
}

TEST(Refusals, AreWhatTheTableOfFeaturesLeavesOut) {
    const std::array refusals{Refusal{Feature::periodic_cell, "they are stiff"}};
    int left_out = 0;
    for (const FeatureRow& row : feature_rows()) {
        EXPECT_EQ(has_feature(refusals, row), row.needs != Feature::periodic_cell) << row.title;
        EXPECT_TRUE(has_feature({}, row)) << row.title;
        left_out += has_feature(refusals, row) ? 0 : 1;
    }
    EXPECT_EQ(left_out, 3);
    for (const Feature feature : {Feature::periodic_cell, Feature::grain_classes, Feature::ellipses,
                                  Feature::clumps, Feature::friction, Feature::wall_friction,
                                  Feature::cohesion, Feature::yield_stress, Feature::driven_grains})
        EXPECT_TRUE(std::any_of(feature_rows().begin(), feature_rows().end(), [&](const FeatureRow& row) {
            return row.needs == feature;
        })) << "a feature without a row";
}

}  // namespace
}  // namespace softgrain
