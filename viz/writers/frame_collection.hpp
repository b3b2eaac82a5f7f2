#pragma once
// A time series of VTK files: NAME.pvd and NAME/NAME_000012.vtp beside it.
#include <filesystem>
#include <span>
#include <string>
#include <vector>

class vtkPolyData;

namespace softgrain {

class FrameCollection {
  public:
    FrameCollection(std::filesystem::path run_dir, std::string name);

    /// Keeps frames 0 to n-1 of an earlier run at these times [s]; later ones are removed. Returns a line if
    /// some that should be kept are lost; they stay in the .pvd.
    std::vector<std::string> resume(std::span<const double> frame_times);

    /// Writes frame number `frame` and then the .pvd, each complete or not at all. Adds TimeValue [s] to the
    /// data. The first frame of a fresh run removes what an older run left. Throws OutputError.
    void add(int frame, double time, vtkPolyData& data);

  private:
    std::string file_name(std::size_t frame) const;
    void remove_frames_from(std::size_t first) const;
    void write_index() const;

    std::filesystem::path run_dir_;
    std::string name_;
    std::vector<double> times_;
    bool started_ = false;
};

}  // namespace softgrain
