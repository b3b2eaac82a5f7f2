#pragma once
// A checksum that tells any change of a bit, for damaged files and for comparing runs. Not against forgers.
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace softgrain {

/// FNV-1a (Fowler, Noll, Vo) over words of 64 bits instead of bytes. The upper half is folded down after
/// every word, because a product carries changes only upwards: two changed signs would else cancel.
class Hash {
  public:
    void add(std::uint64_t word) {
        value_ = (value_ ^ word) * 0x100000001b3U;
        value_ ^= value_ >> 32U;
    }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    void add(std::span<const double> numbers) {
        for (const double number : numbers) add(number);
    }
    /// Zeros fill the last word; the length is told apart by itself.
    void add(std::string_view bytes) {
        add(static_cast<std::uint64_t>(bytes.size()));
        while (!bytes.empty()) {
            std::uint64_t word = 0;
            const std::size_t size = bytes.size() < sizeof(word) ? bytes.size() : sizeof(word);
            std::memcpy(&word, bytes.data(), size);
            add(word);
            bytes.remove_prefix(size);
        }
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace softgrain
