#include "common/packing/generators.hpp"

#include <fmt/format.h>

#include <string_view>

#include "common/errors.hpp"
#include "common/packing/deposition.hpp"
#include "common/packing/geometric.hpp"
#include "common/packing/jam.hpp"
#include "common/packing/random_sequential.hpp"

namespace softgrain {

std::vector<KeyFault> generator_faults(Generator generator, bool has_packing_fraction, bool periodic) {
    std::vector<KeyFault> faults;
    const std::string_view name = generator_names[static_cast<std::size_t>(generator)];
    const bool uncontrolled = generator == Generator::geometric || generator == Generator::deposition;
    const bool needs_walls = uncontrolled || generator == Generator::compaction;
    if (needs_walls && periodic)
        faults.push_back(
            {"generator", fmt::format("= \"{}\" needs walls: use \"growth\" in a periodic cell", name)});
    if (uncontrolled && has_packing_fraction)
        faults.push_back(
            {"packing_fraction", fmt::format("has no effect with generator = \"{}\", what comes of it is not "
                                             "controlled: remove it",
                                             name)});
    if (generator == Generator::random_sequential && !has_packing_fraction)
        faults.push_back(
            {"generator", "= \"random_sequential\" has no end of its own: give packing.packing_fraction"});
    return faults;
}

Packing generate(Generator generator, const std::vector<double>& radii, const PackingRequest& request,
                 Random& random) {
    for (const KeyFault& fault :
         generator_faults(generator, request.packing_fraction.has_value(), request.periodic))
        throw InputError(fmt::format("packing.{} {}", fault.key, fault.message));
    switch (generator) {
        case Generator::random_sequential:
            return random_sequential(radii, request, random);
        case Generator::compaction:
            return compact(radii, request, random).packing;
        case Generator::geometric:
            return geometric(radii, request);
        case Generator::deposition:
            return deposition(radii, request, random);
        case Generator::growth:
            break;
    }
    return jam(radii, request, random).packing;
}

}  // namespace softgrain
