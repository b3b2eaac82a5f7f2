#pragma once
// A solver's complete state as named arrays, so that a restart continues with the same bits.
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/vec.hpp"

namespace softgrain {

class Checkpoint {
  public:
    void put(std::string_view name, std::span<const double> values);
    void put(std::string_view name, std::span<const std::int64_t> values);
    void put(std::string_view name, std::span<const int> values);
    void put(std::string_view name, std::span<const Vec2> values);
    void put(std::string_view name, std::span<const Mat2> values);  ///< stored xx, xy, yx, yy
    void put(std::string_view name, double value) { put(name, std::span<const double>(&value, 1)); }

    /// Throws InputError if there is no such array, or if its size is not a whole number of elements.
    void get(std::string_view name, std::vector<double>& values) const;
    void get(std::string_view name, std::vector<std::int64_t>& values) const;
    void get(std::string_view name, std::vector<int>& values) const;
    void get(std::string_view name, std::vector<Vec2>& values) const;
    void get(std::string_view name, std::vector<Mat2>& values) const;
    double number(std::string_view name) const;

    std::map<std::string, std::vector<double>, std::less<>> numbers;
    std::map<std::string, std::vector<std::int64_t>, std::less<>> integers;
};

}  // namespace softgrain
