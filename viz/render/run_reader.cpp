#include "viz/render/run_reader.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "common/errors.hpp"
#include "viz/csv_table.hpp"
#include "viz/render/vtk_errors.hpp"

namespace softgrain {
namespace fs = std::filesystem;
namespace {

/// VTK gives an empty result for a file cut short; its closing tag is the last thing to be written.
void require_complete(const fs::path& path) {
    constexpr std::string_view closing = "</VTKFile>";
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) throw OutputError(path.string() + ": cannot be read");
    const std::streamoff size = file.tellg();
    std::string tail(static_cast<std::size_t>(std::min<std::streamoff>(size, 64)), '\0');
    file.seekg(size - static_cast<std::streamoff>(tail.size()));
    file.read(tail.data(), static_cast<std::streamsize>(tail.size()));
    if (!file || tail.find(closing) == std::string::npos)
        throw OutputError(path.string() + ": is cut short; write the frame again");
}

/// Number of an attribute of the <Piece>, -1 if there is none.
long long piece_count(const std::string& header, const std::string& attribute) {
    const std::size_t at = header.find(attribute + "=\"");
    if (at == std::string::npos) return -1;
    return std::atoll(header.c_str() + at + attribute.size() + 2);
}

void require_counts(const fs::path& path, vtkPolyData& data) {
    std::ifstream file(path, std::ios::binary);
    std::string header(4096, '\0');
    file.read(header.data(), static_cast<std::streamsize>(header.size()));
    bool good = piece_count(header, "NumberOfPoints") == data.GetNumberOfPoints() &&
                piece_count(header, "NumberOfVerts") == data.GetNumberOfVerts() &&
                piece_count(header, "NumberOfLines") == data.GetNumberOfLines() &&
                piece_count(header, "NumberOfPolys") == data.GetNumberOfPolys();
    for (int a = 0; good && a < data.GetCellData()->GetNumberOfArrays(); ++a)
        good = data.GetCellData()->GetAbstractArray(a)->GetNumberOfTuples() == data.GetNumberOfCells();
    for (int a = 0; good && a < data.GetPointData()->GetNumberOfArrays(); ++a)
        good = data.GetPointData()->GetAbstractArray(a)->GetNumberOfTuples() == data.GetNumberOfPoints();
    if (!good) throw OutputError(path.string() + ": is damaged: fewer data than its header says");
}

std::vector<FrameFile> read_optional_pvd(const fs::path& path) {
    return fs::exists(path) ? read_pvd(path) : std::vector<FrameFile>{};
}

vtkSmartPointer<vtkPolyData> read_at_time(const std::vector<FrameFile>& files, double time) {
    for (const FrameFile& file : files)
        if (file.time == time) return read_vtp(file.path);
    return nullptr;
}

/// A column's values at the times of the frames; nan if it is empty.
std::vector<double> at_frames(const CsvTable* history, const std::vector<double>& column,
                              const std::vector<FrameFile>& frames) {
    std::vector<double> values(frames.size(), std::numeric_limits<double>::quiet_NaN());
    if (history == nullptr || !history->has("time") || column.empty()) return values;
    const auto& time = history->column("time");
    for (std::size_t f = 0; f < frames.size(); ++f) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t r = 0; r < time.size(); ++r) {
            const double distance = std::abs(time[r] - frames[f].time);
            if (distance <= nearest) {
                nearest = distance;
                values[f] = column[r];
            }
        }
    }
    return values;
}

std::vector<double> column_or_none(const CsvTable* history, std::string_view name) {
    return history != nullptr && history->has(name) ? history->column(name) : std::vector<double>{};
}

std::vector<double> strain_path(const CsvTable* history) {
    std::vector<double> path;
    for (const char* name : {"axial_strain", "shear_strain"}) {
        const auto strain = column_or_none(history, name);
        if (path.empty()) path.assign(strain.size(), 0.0);
        double travelled = 0.0;
        for (std::size_t r = 1; r < strain.size(); ++r) {
            travelled += std::abs(strain[r] - strain[r - 1]);
            path[r] += travelled;
        }
    }
    return path;
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_vtp(const fs::path& path) {
    require_complete(path);
    take_vtk_error();
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    const std::string error = take_vtk_error();
    if (!error.empty()) throw OutputError(fmt::format("{}: is damaged: {}", path.string(), error));
    vtkSmartPointer<vtkPolyData> data = reader->GetOutput();
    require_counts(path, *data);
    return data;
}

std::vector<FrameFile> read_pvd(const fs::path& path) {
    require_complete(path);
    take_vtk_error();
    const auto root =
        vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
    vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
    if (!take_vtk_error().empty() || collection == nullptr)
        throw OutputError(path.string() + ": is not a ParaView collection");
    std::vector<FrameFile> frames;
    for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
        vtkXMLDataElement* entry = collection->GetNestedElement(k);
        double time = 0.0;
        const char* file = entry->GetAttribute("file");
        if (file == nullptr || entry->GetScalarAttribute("timestep", time) != 1)
            throw OutputError(fmt::format("{}: entry {} has no file or time", path.string(), k));
        frames.push_back({time, path.parent_path() / file});
    }
    return frames;
}

RunReader::RunReader(std::string label, fs::path directory)
    : label_(std::move(label)), directory_(std::move(directory)) {
    if (!fs::exists(directory_ / "grains.pvd"))
        throw InputError(
            fmt::format("{}: has no grains.pvd; is it the folder of a run?", directory_.string()));
    grains_ = read_pvd(directory_ / "grains.pvd");
    if (grains_.empty())
        throw InputError(fmt::format("{}: has no frames yet", (directory_ / "grains.pvd").string()));
    contacts_ = read_optional_pvd(directory_ / "contacts.pvd");
    walls_ = read_optional_pvd(directory_ / "walls.pvd");
    parts_ = read_optional_pvd(directory_ / "parts.pvd");
    part_contacts_ = read_optional_pvd(directory_ / "part_contacts.pvd");
    std::optional<CsvTable> history;
    if (fs::exists(directory_ / "history.csv")) history.emplace(directory_ / "history.csv");
    const CsvTable* table = history ? &*history : nullptr;
    packing_fraction_ = at_frames(table, column_or_none(table, "packing_fraction"), grains_);
    mean_stress_ = at_frames(table, column_or_none(table, "mean_stress"), grains_);
    coordination_number_ = at_frames(table, column_or_none(table, "coordination_number"), grains_);
    strain_path_ = at_frames(table, strain_path(table), grains_);
    for (const FrameFile& file : grains_) time_.push_back(file.time);
}

bool RunReader::has_ended() const {
    return fs::exists(directory_ / "run.json");
}

void RunReader::require_packing_fraction() const {
    if (std::ranges::any_of(packing_fraction_, [](double phi) { return std::isfinite(phi); })) return;
    throw InputError(fmt::format("{}: gives no packing_fraction at its frames; use --at",
                                 (directory_ / "history.csv").string()));
}

std::size_t RunReader::frame_at_fraction(double fraction) const {
    return static_cast<std::size_t>(std::lround(fraction * static_cast<double>(grains_.size() - 1)));
}

std::size_t RunReader::frame_at_packing_fraction(double packing_fraction) const {
    require_packing_fraction();
    std::optional<std::size_t> best;
    for (std::size_t f = 0; f < grains_.size(); ++f) {
        const double distance = std::abs(packing_fraction_[f] - packing_fraction);
        if (std::isnan(distance)) continue;
        if (!best || distance < std::abs(packing_fraction_[*best] - packing_fraction)) best = f;
    }
    return best.value();
}

Frame RunReader::read(std::size_t frame, bool parts) const {
    const FrameFile& file = grains_.at(frame);
    return {file.time,
            packing_fraction_[frame],
            mean_stress_[frame],
            coordination_number_[frame],
            read_vtp(file.path),
            read_at_time(contacts_, file.time),
            read_at_time(walls_, file.time),
            parts ? read_at_time(parts_, file.time) : nullptr,
            parts ? read_at_time(part_contacts_, file.time) : nullptr};
}

}  // namespace softgrain
