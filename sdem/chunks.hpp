#pragma once
// Work cut into pieces that do not depend on the number of threads.
#include <algorithm>
#include <cstddef>

namespace softgrain::sdem {

/// [0, size) in chunks of `length`, the last one shorter.
class Chunks {
  public:
    Chunks(std::size_t size, std::size_t length) : size_(size), length_(length) {}
    std::size_t count() const { return (size_ + length_ - 1) / length_; }
    std::size_t begin(std::size_t chunk) const { return chunk * length_; }
    std::size_t end(std::size_t chunk) const { return std::min(size_, (chunk + 1) * length_); }

  private:
    std::size_t size_, length_;
};

}  // namespace softgrain::sdem
