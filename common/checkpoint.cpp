#include "common/checkpoint.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"

namespace softgrain {
namespace {

template <class T>
const std::vector<T>& find(const std::map<std::string, std::vector<T>, std::less<>>& arrays,
                           std::string_view name, std::size_t components) {
    const auto it = arrays.find(name);
    if (it == arrays.end()) throw InputError(fmt::format("checkpoint has no array '{}'", name));
    if (it->second.size() % components != 0)
        throw InputError(fmt::format("checkpoint array '{}' has a broken size {}", name, it->second.size()));
    return it->second;
}

}  // namespace

void Checkpoint::put(std::string_view name, std::span<const double> values) {
    numbers.insert_or_assign(std::string(name), std::vector<double>(values.begin(), values.end()));
}
void Checkpoint::put(std::string_view name, std::span<const std::int64_t> values) {
    integers.insert_or_assign(std::string(name), std::vector<std::int64_t>(values.begin(), values.end()));
}
void Checkpoint::put(std::string_view name, std::span<const int> values) {
    integers.insert_or_assign(std::string(name), std::vector<std::int64_t>(values.begin(), values.end()));
}
void Checkpoint::put(std::string_view name, std::span<const Vec2> values) {
    std::vector<double> flat;
    flat.reserve(values.size() * 2);
    for (const Vec2& v : values) flat.insert(flat.end(), {v.x(), v.y()});
    numbers.insert_or_assign(std::string(name), std::move(flat));
}
void Checkpoint::put(std::string_view name, std::span<const Mat2> values) {
    std::vector<double> flat;
    flat.reserve(values.size() * 4);
    for (const Mat2& m : values) flat.insert(flat.end(), {m(0, 0), m(0, 1), m(1, 0), m(1, 1)});
    numbers.insert_or_assign(std::string(name), std::move(flat));
}

void Checkpoint::get(std::string_view name, std::vector<double>& values) const {
    values = find(numbers, name, 1);
}
void Checkpoint::get(std::string_view name, std::vector<std::int64_t>& values) const {
    values = find(integers, name, 1);
}
void Checkpoint::get(std::string_view name, std::vector<int>& values) const {
    const auto& stored = find(integers, name, 1);
    values.assign(stored.begin(), stored.end());
}
void Checkpoint::get(std::string_view name, std::vector<Vec2>& values) const {
    const auto& flat = find(numbers, name, 2);
    values.resize(flat.size() / 2);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = Vec2{flat[2 * k], flat[2 * k + 1]};
}
void Checkpoint::get(std::string_view name, std::vector<Mat2>& values) const {
    const auto& flat = find(numbers, name, 4);
    values.resize(flat.size() / 4);
    for (std::size_t k = 0; k < values.size(); ++k)
        values[k] << flat[4 * k], flat[4 * k + 1], flat[4 * k + 2], flat[4 * k + 3];
}
double Checkpoint::number(std::string_view name) const {
    const auto& values = find(numbers, name, 1);
    if (values.size() != 1) throw InputError(fmt::format("checkpoint entry '{}' is not one number", name));
    return values.front();
}

}  // namespace softgrain
