#include "common/packing/generators.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/packing/jam.hpp"
#include "common/packing/random_sequential.hpp"

namespace softgrain {

std::vector<KeyFault> generator_faults(Generator generator, bool has_packing_fraction, bool periodic) {
    std::vector<KeyFault> faults;
    if (generator == Generator::compaction && periodic)
        faults.push_back({"generator", "= \"compaction\" needs walls: use \"growth\" in a periodic cell"});
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
        case Generator::growth:
            break;
    }
    return jam(radii, request, random).packing;
}

}  // namespace softgrain
