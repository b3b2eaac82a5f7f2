#pragma once
// Observers that write each frame for ParaView: grains.pvd, contacts.pvd, walls.pvd, and parts.pvd with
// part_contacts.pvd.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/observer.hpp"
#include "viz/writers/frame_collection.hpp"

namespace softgrain {

/// Above this many grains a run writes points instead of outlines, as with sampling.outlines = false. At 64
/// points an outline takes 1.5 kB, so that a frame of 1e5 grains has 150 MB, and in a picture of 2000 pixels
/// such a grain is 6 pixels wide: its shape cannot be seen.
constexpr std::size_t most_outlined_grains = 100'000;

/// What GrainWriter writes of a run of so many grains. `outlines`: if they can be had.
Need grain_data(std::size_t grains, bool outlines);

/// Grains as closed counter-clockwise polygons (or, without Need::outlines, as points at their centroids,
/// with point data radius, that of a disc of the same area, and with Need::stress stress and mean_stress)
/// with cell data: grain, mass, area, reference_area, velocity, stress, mean_stress, deviatoric_stress,
/// aspect_ratio, orientation, asphericity, circularity, grain_class if there is more than one, and the
/// method's own fields. In a periodic cell each grain is drawn where its centroid lies in the cell.
class GrainWriter final : public Observer {
  public:
    /// `needs`: which of area, stress, outlines and fields to write. `grain_class` [n] or empty.
    GrainWriter(std::filesystem::path run_dir, Need needs, std::vector<std::uint8_t> grain_class = {});
    Need need(const Sample& sample) const override;
    /// Throws OutputError, and DivergedError if a grain's position, outline or stress is not finite.
    void observe(const GrainView& view, const Sample& sample) override;
    std::vector<std::string> resume(std::span<const double> frame_times) override;

  private:
    FrameCollection frames_;
    Need needs_;
    std::vector<std::uint8_t> grain_class_;
};

/// Contacts as lines centroid - contact point - centroid, or centroid - foot of the contact point on the
/// wall; a contact across a periodic cell as two, each from one grain to the contact point. Cell data:
/// normal_force, tangential_force, force, normal, contact_length, grain_i, grain_j (-1 - wall), is_wall.
class ContactWriter final : public Observer {
  public:
    explicit ContactWriter(std::filesystem::path run_dir);
    Need need(const Sample& sample) const override;
    /// Throws OutputError, and DivergedError if a contact's point or force is not finite.
    void observe(const GrainView& view, const Sample& sample) override;
    std::vector<std::string> resume(std::span<const double> frame_times) override;

  private:
    FrameCollection frames_;
};

/// What grains are made of (Need::parts), as points with point data: grain, radius, displacement since the
/// start, and the method's own fields. Their contacts as lines between them, or to a wall; across a periodic
/// cell as two halves. Cell data: normal_force, tangential_force, part_i, part_j (-1 - wall), grain_i,
/// grain_j, is_wall. Of a method whose grains have no parts there are no files.
class PartWriter final : public Observer {
  public:
    /// `contacts`: write those of the parts too.
    PartWriter(std::filesystem::path run_dir, bool contacts);
    Need need(const Sample& sample) const override;
    /// Throws OutputError, and DivergedError if a position, field or force is not finite.
    void observe(const GrainView& view, const Sample& sample) override;
    std::vector<std::string> resume(std::span<const double> frame_times) override;

  private:
    std::filesystem::path run_dir_;
    bool contacts_;
    FrameCollection parts_, part_contacts_;
};

/// The four walls, or the edges of a periodic cell (field data periodic = 1, reduced tilt), as lines with
/// cell data: wall (0 left, 1 right, 2 bottom, 3 top), wall_force, normal_force, wall_stress.
class WallWriter final : public Observer {
  public:
    explicit WallWriter(std::filesystem::path run_dir);
    Need need(const Sample& sample) const override;
    /// Throws OutputError, and DivergedError if a wall's position or force is not finite.
    void observe(const GrainView& view, const Sample& sample) override;
    std::vector<std::string> resume(std::span<const double> frame_times) override;

  private:
    FrameCollection frames_;
};

}  // namespace softgrain
