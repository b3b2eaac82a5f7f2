#include <gtest/gtest.h>

#include "app/memory.hpp"
#include "app/methods.hpp"

namespace softgrain {
namespace {

/// A generated packing is scaled to a box of given size, and its grains have as many more discs. Found by
/// random scenarios.
TEST(Memory, DiscsOfGrainsThatAreScaledToTheBoxAreCounted) {
    const auto memory = [](const std::string& box) {
        const std::string text =
            "[packing]\ncount = 9\nradius_mean = 1e-3\nradius_min = 1e-4\nradius_max = 3e-3\n" + box +
            "[bpm]\ndisc_diameter = 1e-3\n[[loading]]\nuntil_strain = 0.1\n";
        return estimated_memory(parse_scenario(text, "s.toml", {}, method_keys()), find_method("bpm"));
    };
    EXPECT_LT(memory(""), 5e7);
    // Discs of a square millimetre in a square metre, 1.2 kB each.
    EXPECT_NEAR(memory("[box]\nwidth = 1\nheight = 1\n"), 1.4e9, 0.2e9);
}

}  // namespace
}  // namespace softgrain
