#include "viz/writers/frame_collection.hpp"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <charconv>
#include <system_error>
#include <utility>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/lost_files.hpp"
#include "viz/writers/vtp_file.hpp"

namespace softgrain {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view begin_of_vtp = "<VTKFile ", end_of_vtp = "</VTKFile>\n";

}  // namespace

FrameCollection::FrameCollection(fs::path run_dir, std::string name)
    : run_dir_(std::move(run_dir)), name_(std::move(name)) {}

std::string FrameCollection::file_name(std::size_t frame) const {
    return fmt::format("{0}/{0}_{1:06d}.vtp", name_, frame);
}

std::vector<std::string> FrameCollection::resume(std::span<const double> frame_times) {
    LostFiles lost;
    for (std::size_t frame = 0; frame < frame_times.size(); ++frame) {
        const fs::path path = run_dir_ / file_name(frame);
        lost.add(path, damage_at_ends(path, begin_of_vtp, end_of_vtp));
    }
    times_.assign(frame_times.begin(), frame_times.end());
    started_ = true;
    make_directories(run_dir_ / name_);
    write_index();
    remove_frames_from(times_.size());
    std::vector<std::string> lines;
    lost.say(lines);
    return lines;
}

void FrameCollection::add(int frame, double time, vtkPolyData& data) {
    if (!started_) {
        make_directories(run_dir_ / name_);
        remove_frames_from(0);
        started_ = true;
    }
    if (frame < 0 || static_cast<std::size_t>(frame) != times_.size())
        throw OutputError(fmt::format("{}.pvd: frame {} follows {} frames", (run_dir_ / name_).string(),
                                      frame, times_.size()));
    vtkNew<vtkDoubleArray> time_value;
    time_value->SetName("TimeValue");
    time_value->InsertNextValue(time);
    data.GetFieldData()->AddArray(time_value);
    write_vtp(run_dir_ / file_name(times_.size()), data);
    times_.push_back(time);
    write_index();
}

void FrameCollection::remove_frames_from(std::size_t first) const {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(run_dir_ / name_, error)) {
        const std::string file = entry.path().filename().string();
        const std::string start = name_ + "_";
        if (!file.starts_with(start)) continue;
        std::size_t number = 0;
        const char* digits = file.data() + start.size();
        const auto parsed = std::from_chars(digits, file.data() + file.size(), number);
        if (parsed.ec != std::errc{} || number < first) continue;
        const std::string_view suffix(parsed.ptr);
        if (suffix != ".vtp" && suffix != ".vtp.part") continue;
        if (!fs::remove(entry.path(), error) && error) break;
    }
    if (error)
        throw OutputError(
            fmt::format("{}: cannot remove old frames: {}", (run_dir_ / name_).string(), error.message()));
}

void FrameCollection::write_index() const {
    std::string text =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "  <Collection>\n";
    for (std::size_t frame = 0; frame < times_.size(); ++frame)
        text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                            times_[frame], file_name(frame));
    text += "  </Collection>\n</VTKFile>\n";
    write_file_atomically(run_dir_ / (name_ + ".pvd"), text);
}

}  // namespace softgrain
