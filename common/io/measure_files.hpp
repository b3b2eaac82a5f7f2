#pragma once
// Measures that are more than a number per sample: a CSV file each, per frame, for those that were asked for.
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/observer.hpp"

namespace softgrain {

/// What sampling.measures may name:
/// - forces: how normal forces between grains are distributed;
/// - chains: stress of each grain from its contacts, and the force chain it belongs to;
/// - grains: centre, velocity, radius, and whether it is driven, of each grain;
/// - pair_correlation: g(r);
/// - tessellation: triangles between grain centres with void ratio and strain since the last frame.
inline constexpr std::array<std::string_view, 5> measure_names{"forces", "chains", "grains",
                                                               "pair_correlation", "tessellation"};

/// The names in a list parted by commas.
std::vector<std::string> measures_in(std::string_view list);

/// Writes `measures/<name>_<frame>.csv` in the run's folder, and centres_<frame>.csv with a tessellation:
/// from there the next frame takes what strains refer to, so that a run that goes on needs nothing else.
class MeasureWriter final : public Observer {
  public:
    MeasureWriter(std::filesystem::path run_dir, std::vector<std::string> measures);
    Need need(const Sample& sample) const override;
    /// Throws OutputError.
    void observe(const GrainView& view, const Sample& sample) override;
    /// Throws InputError if the centres are lost that the next tessellation refers to.
    std::vector<std::string> resume(std::span<const double> frame_times) override;

  private:
    bool wanted(std::string_view measure) const;
    std::filesystem::path path(std::string_view name, int frame) const;
    void write_tessellation(const GrainView& view, int frame) const;

    std::filesystem::path folder_;
    std::vector<std::string> measures_;
};

}  // namespace softgrain
