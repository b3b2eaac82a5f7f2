#pragma once
// Prepared aggregates kept between runs, one file for each packing.
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "bpm/aggregate.hpp"

namespace softgrain::bpm {

/// A folder of files named after what they follow from. Whatever goes wrong with it costs time only: a file
/// that is absent, damaged or of another version is not used, and what cannot be written is not.
class AggregateCache {
  public:
    /// A preparation of fewer discs takes less than a second and is not kept.
    static constexpr int least_discs = 2000;
    /// The files last used longest ago are removed beyond this size [bytes]; a disc takes 24.
    static constexpr std::uintmax_t most_bytes = 256'000'000;

    /// Without a folder nothing is kept.
    explicit AggregateCache(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

    /// The aggregates of these specs as they were prepared, to the bit; none if they are not kept.
    std::optional<std::vector<Aggregate>> find(std::span<const AggregateSpec> specs) const;
    void keep(std::span<const AggregateSpec> specs, std::span<const Aggregate> aggregates) const;

    /// File for these specs; none if they would not be kept.
    std::optional<std::filesystem::path> file_of(std::span<const AggregateSpec> specs) const;

  private:
    void remove_oldest() const;

    std::optional<std::filesystem::path> folder_;
};

/// From the environment: SOFTGRAIN_CACHE (a folder, or "off"), else XDG_CACHE_HOME/softgrain, else
/// HOME/.cache/softgrain.
std::optional<std::filesystem::path> cache_folder();

}  // namespace softgrain::bpm
