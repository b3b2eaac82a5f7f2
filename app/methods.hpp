#pragma once
// The table of methods: the one place that knows them all.
#include <optional>

#include "common/io/scenario_file.hpp"
#include "common/solver.hpp"

namespace softgrain {

std::span<const Method> methods();

/// Throws InputError with the list of names if there is no such method.
const Method& find_method(std::string_view name);

/// The scenario tables of all methods, each with the keys that every method has (its own loading rate and
/// equilibrium).
std::span<const MethodKeys> method_keys();

/// The scenario as this method runs it: a rate or an equilibrium in the method's table replaces that of
/// the stages, and stages that name no rate have the method's own.
Scenario scenario_for(const Scenario& scenario, const Method& method);

}  // namespace softgrain
