#pragma once
// Random numbers that are the same with every standard library.
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace softgrain {

/// mt19937_64 is fixed by the standard; the distributions of `<random>` are not, so they are not used.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [0, 1), 53 bits.
    double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
    /// Uniform in [low, high).
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Any order of the elements, each as likely (Fisher and Yates).
    template <class T>
    void shuffle(std::vector<T>& elements) {
        for (std::size_t k = elements.size(); k > 1; --k)
            std::swap(elements[k - 1], elements[static_cast<std::size_t>(unit() * static_cast<double>(k))]);
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace softgrain
