#include "common/settings.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace softgrain {

Settings::Settings(std::span<const KeySpec> keys) {
    for (const KeySpec& key : keys) values_.emplace(key.name, key.default_value);
}

namespace {

template <class T>
const T& value_of(const std::map<std::string, Value, std::less<>>& values, std::string_view name) {
    const auto it = values.find(name);
    const T* value = it == values.end() ? nullptr : std::get_if<T>(&it->second);
    if (value == nullptr) throw std::logic_error(fmt::format("setting '{}' has no value of this type", name));
    return *value;
}

}  // namespace

bool Settings::has(std::string_view name) const {
    const auto it = values_.find(name);
    return it != values_.end() && !std::holds_alternative<std::monostate>(it->second);
}
double Settings::number(std::string_view name) const {
    return value_of<double>(values_, name);
}
std::int64_t Settings::integer(std::string_view name) const {
    return value_of<std::int64_t>(values_, name);
}
bool Settings::boolean(std::string_view name) const {
    return value_of<bool>(values_, name);
}
const std::string& Settings::text(std::string_view name) const {
    return value_of<std::string>(values_, name);
}
void Settings::set(std::string_view name, Value value) {
    values_.insert_or_assign(std::string(name), std::move(value));
}

}  // namespace softgrain
