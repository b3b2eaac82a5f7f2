#include "viz/writers/vtp_file.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <string>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"

namespace softgrain {
namespace {

/// -0 becomes 0. They are equal, so which of them VTK writes as an array's range depends on its threads.
void unsign_zeros(vtkDataArray* array) {
    auto* numbers = vtkDoubleArray::SafeDownCast(array);
    if (numbers == nullptr) return;
    for (vtkIdType k = 0; k < numbers->GetNumberOfValues(); ++k)
        numbers->SetValue(k, numbers->GetValue(k) + 0.0);
}

}  // namespace

void write_vtp(const std::filesystem::path& path, vtkPolyData& data) {
    if (vtkPoints* points = data.GetPoints()) unsign_zeros(points->GetData());
    for (vtkFieldData* fields : {static_cast<vtkFieldData*>(data.GetPointData()),
                                 static_cast<vtkFieldData*>(data.GetCellData()), data.GetFieldData()})
        for (int k = 0; k < fields->GetNumberOfArrays(); ++k) unsign_zeros(fields->GetArray(k));
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(&data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetHeaderTypeToUInt64();
    writer->SetCompressorTypeToZLib();
    writer->WriteToOutputStringOn();
    if (writer->Write() != 1 || writer->GetOutputString().empty())
        throw OutputError(fmt::format("{}: VTK could not encode the data", path.string()));
    write_file_atomically(path, writer->GetOutputString());
}

vtkSmartPointer<vtkDoubleArray> add_numbers(vtkDataSetAttributes& to, std::string_view name,
                                            std::string_view unit, int components, std::size_t tuples) {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(std::string(name).c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
    array->Fill(0.0);
    if (!unit.empty()) array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), std::string(unit).c_str());
    to.AddArray(array);
    return array;
}

void set_tensor(vtkDoubleArray& array, std::size_t tuple, double xx, double xy, double yx, double yy) {
    const double components[9] = {xx, xy, 0.0, yx, yy, 0.0, 0.0, 0.0, 0.0};
    array.SetTuple(static_cast<vtkIdType>(tuple), components);
}

void add_field(vtkDataSetAttributes& to, const Field& field, std::size_t tuples) {
    const int written = field.components == 1 ? 1 : field.components == 2 ? 3 : 9;
    auto array = add_numbers(to, field.name, field.unit, written, tuples);
    for (std::size_t k = 0; k < tuples; ++k) {
        const double* v = field.values.data() + static_cast<std::size_t>(field.components) * k;
        const auto tuple = static_cast<vtkIdType>(k);
        if (field.components == 1)
            array->SetValue(tuple, v[0]);
        else if (field.components == 2)
            array->SetTuple3(tuple, v[0], v[1], 0.0);
        else
            set_tensor(*array, k, v[0], v[1], v[2], v[3]);
    }
}

vtkSmartPointer<vtkIdTypeArray> add_ids(vtkDataSetAttributes& to, std::string_view name, std::size_t tuples) {
    auto array = vtkSmartPointer<vtkIdTypeArray>::New();
    array->SetName(std::string(name).c_str());
    array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
    array->Fill(0);
    to.AddArray(array);
    return array;
}

}  // namespace softgrain
