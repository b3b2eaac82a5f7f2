#include "viz/writers/vtp_file.hpp"

#include <fmt/format.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <string>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"

namespace softgrain {

void write_vtp(const std::filesystem::path& path, vtkPolyData& data) {
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

vtkSmartPointer<vtkIdTypeArray> add_ids(vtkDataSetAttributes& to, std::string_view name, std::size_t tuples) {
    auto array = vtkSmartPointer<vtkIdTypeArray>::New();
    array->SetName(std::string(name).c_str());
    array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
    array->Fill(0);
    to.AddArray(array);
    return array;
}

}  // namespace softgrain
