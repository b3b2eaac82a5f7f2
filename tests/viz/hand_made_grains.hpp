#pragma once
// A state of grains made by hand, so that writers and pictures can be tested without a solver.
#include <filesystem>
#include <string>
#include <vector>

#include "common/grain_view.hpp"
#include "common/observer.hpp"

namespace softgrain {

/// n x n grains on a grid with `strain` of isotropic compression from a box of 1 m: rounder at the start,
/// squarer later. Neighbours and walls are in contact; forces vary by grain. Every fourth outline is concave.
class HandMadeGrains {
  public:
    HandMadeGrains(int n, double strain, double time);
    GrainView view() const;
    double packing_fraction() const;
    double mean_stress() const;

    double time;
    Box box;
    std::vector<Vec2> centroid, velocity, outline_point;
    std::vector<double> mass, reference_area, area, temperature, stretch;
    std::vector<Mat2> stress;
    std::vector<int> outline_offset;
    std::vector<GrainContact> contacts;
    std::array<Vec2, 4> wall_force;

  private:
    void add_grain(int row, int column, double spacing);
    void add_contacts(int n);
};

/// Four discs in each grain, on a square around its centre, that touch their neighbours in the grain, those
/// of the next grains, and walls.
struct HandMadeParts {
    static constexpr int per_grain = 4;

    explicit HandMadeParts(const HandMadeGrains& grains);
    PartView view() const;

    std::vector<Vec2> position, reference;
    std::vector<double> radius, velocity, heat;
    std::vector<int> grain;
    std::vector<PartContact> contacts;
};

/// Writes `frames` frames up to a strain with all three writers, and history.csv with two rows per frame.
void write_hand_made_run(const std::filesystem::path& directory, int n, int frames, double strain = 0.2);

Sample frame_sample(int frame);

/// A folder that is removed with the object.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace softgrain
