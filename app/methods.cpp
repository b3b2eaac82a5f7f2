#include "app/methods.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bpm/method.hpp"
#include "common/errors.hpp"
#include "mpm/method.hpp"
#include "rigid_dem/method.hpp"
#include "sdem/method.hpp"

namespace softgrain {
namespace {

/// Quasi-static means another rate for another material: an aggregate flows where an elastic disc rings.
const std::vector<KeySpec> keys_of_every_method{
    {"strain_rate", KeyType::number, std::monostate{}, "1/s", "replaces the rate of every loading stage",
     positive},
    {"inertial_number", KeyType::number, std::monostate{}, "", "replaces the rate of every loading stage",
     positive},
    {"until_unbalanced", KeyType::number, std::monostate{}, "",
     "replaces that of every stage which has one or goes to a stress", positive},
};

std::vector<KeySpec> with_common_keys(std::span<const KeySpec> own) {
    std::vector<KeySpec> all(own.begin(), own.end());
    all.insert(all.end(), keys_of_every_method.begin(), keys_of_every_method.end());
    return all;
}

}  // namespace

std::span<const Method> methods() {
    static const std::array table{sdem::method(), bpm::method(), rigid_dem::method(), mpm::method()};
    return table;
}

const Method& find_method(std::string_view name) {
    const auto all = methods();
    const auto it = std::ranges::find(all, name, &Method::name);
    if (it != all.end()) return *it;
    std::vector<std::string_view> names;
    for (const Method& m : all) names.push_back(m.name);
    throw InputError(
        fmt::format("there is no method '{}'; the methods are {}", name, fmt::join(names, ", ")));
}

std::span<const MethodKeys> method_keys() {
    static const std::vector<std::vector<KeySpec>> keys = [] {
        std::vector<std::vector<KeySpec>> all;
        for (const Method& m : methods()) all.push_back(with_common_keys(m.keys()));
        return all;
    }();
    static const std::vector<MethodKeys> table = [] {
        std::vector<MethodKeys> rows;
        for (std::size_t m = 0; m < keys.size(); ++m)
            rows.push_back({methods()[m].name, keys[m], methods()[m].faults});
        return rows;
    }();
    return table;
}

Scenario scenario_for(const Scenario& scenario, const Method& method) {
    Scenario own = scenario;
    const Settings& settings = own.method_settings.at(std::string(method.name));
    const bool by_rate = settings.has("strain_rate");
    const bool by_inertia = settings.has("inertial_number");
    if (by_rate && by_inertia)
        throw InputError(fmt::format("{}: [{}] has both strain_rate and inertial_number; keep one",
                                     scenario.source.string(), method.name));
    for (LoadingStage& stage : own.loading) {
        if (settings.has("until_unbalanced") && (stage.until_unbalanced || stage.seeks_stress()))
            stage.until_unbalanced = settings.number("until_unbalanced");
        if (stage.seeks_stress() && !stage.until_unbalanced) stage.until_unbalanced = method.at_rest;
        if (!stage.has_rate()) continue;
        if (!stage.strain_rate && !stage.inertial_number) stage.inertial_number = method.inertial_number;
        if (!by_rate && !by_inertia) continue;
        stage.strain_rate.reset();
        stage.inertial_number.reset();
        (by_rate ? stage.strain_rate : stage.inertial_number) =
            settings.number(by_rate ? "strain_rate" : "inertial_number");
    }
    return own;
}

}  // namespace softgrain
