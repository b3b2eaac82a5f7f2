#include "viz/writers/vtp_values.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>

#include "common/errors.hpp"

namespace softgrain {
namespace {

bool is_finite(vtkDataArray& array) {
    for (vtkIdType tuple = 0; tuple < array.GetNumberOfTuples(); ++tuple)
        for (int k = 0; k < array.GetNumberOfComponents(); ++k)
            if (!std::isfinite(array.GetComponent(tuple, k))) return false;
    return true;
}

}  // namespace

std::optional<std::string> not_finite_in_vtp(const std::filesystem::path& path) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkPolyData* data = reader->GetOutput();
    if (reader->GetErrorCode() != 0 || data == nullptr)
        throw InputError(fmt::format("{}: VTK cannot read it", path.string()));
    if (data->GetPoints() != nullptr && !is_finite(*data->GetPoints()->GetData())) return "points";
    for (vtkFieldData* fields : {static_cast<vtkFieldData*>(data->GetPointData()),
                                 static_cast<vtkFieldData*>(data->GetCellData()), data->GetFieldData()})
        for (int k = 0; k < fields->GetNumberOfArrays(); ++k)
            if (vtkDataArray* array = fields->GetArray(k); array != nullptr && !is_finite(*array))
                return array->GetName();
    return std::nullopt;
}

}  // namespace softgrain
