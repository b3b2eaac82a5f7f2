#pragma once
// The written frames of a run, read back with every check VTK leaves out.
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>
#include <vector>

namespace softgrain {

/// Reads a .vtp file. Throws OutputError naming it if it is missing, truncated or damaged.
vtkSmartPointer<vtkPolyData> read_vtp(const std::filesystem::path& path);

struct FrameFile {
    double time;  ///< [s]
    std::filesystem::path path;
};
/// The entries of a .pvd file. Throws OutputError.
std::vector<FrameFile> read_pvd(const std::filesystem::path& path);

/// What is drawn of one frame. Contacts and walls are null if the run did not write them, parts and their
/// contacts if they were not asked for either.
struct Frame {
    double time;                                                ///< [s]
    double packing_fraction, mean_stress, coordination_number;  ///< nan if the history does not have them
    vtkSmartPointer<vtkPolyData> grains, contacts, walls, parts, part_contacts;
};

class RunReader {
  public:
    /// Throws InputError if there is no run with frames, OutputError if its files are damaged.
    RunReader(std::string label, std::filesystem::path directory);

    const std::string& label() const { return label_; }
    std::size_t frame_count() const { return grains_.size(); }
    /// The run has said how it ended; else it is going on, or was killed.
    bool has_ended() const;

    /// [frames] nan without a history.
    const std::vector<double>& packing_fractions() const { return packing_fraction_; }
    /// [frames] Sum of all changes of axial and shear strain so far; nan without a history.
    const std::vector<double>& strain_paths() const { return strain_path_; }
    const std::vector<double>& times() const { return time_; }  ///< [frames] [s]
    /// Throws InputError if no frame has a packing fraction.
    void require_packing_fraction() const;

    /// The frame at this fraction (0 to 1) of the list of frames.
    std::size_t frame_at_fraction(double fraction) const;
    /// The frame whose packing fraction in the history is nearest. Throws InputError without a history.
    std::size_t frame_at_packing_fraction(double packing_fraction) const;
    /// `parts`: with what the grains are made of, if the run wrote it.
    Frame read(std::size_t frame, bool parts = false) const;

  private:
    std::string label_;
    std::filesystem::path directory_;
    std::vector<FrameFile> grains_, contacts_, walls_, parts_, part_contacts_;
    std::vector<double> packing_fraction_, mean_stress_, coordination_number_;  ///< one per frame
    std::vector<double> time_, strain_path_;                                    ///< one per frame
};

}  // namespace softgrain
