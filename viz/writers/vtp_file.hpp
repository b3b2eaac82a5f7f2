#pragma once
// VTK XML files and the arrays in them. VTK's own writer reports neither a full disk nor a truncated file.
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string_view>

#include "common/grain_view.hpp"

class vtkDataSetAttributes;
class vtkDoubleArray;
class vtkIdTypeArray;
class vtkPolyData;

namespace softgrain {

/// Writes `data` as appended, compressed binary; complete or not at all. Throws OutputError.
void write_vtp(const std::filesystem::path& path, vtkPolyData& data);

/// Adds an array of `components` values a tuple [tuples x components], all 0. `unit` ("" for none) is kept in
/// VTK's information key UNITS_LABEL.
vtkSmartPointer<vtkDoubleArray> add_numbers(vtkDataSetAttributes& to, std::string_view name,
                                            std::string_view unit, int components, std::size_t tuples);
/// A scalar, a vector (third component 0) or a tensor. The field has a value for each of the `tuples`.
void add_field(vtkDataSetAttributes& to, const Field& field, std::size_t tuples);
/// A plane tensor as the nine components ParaView takes for a tensor; zero out of plane.
void set_tensor(vtkDoubleArray& array, std::size_t tuple, double xx, double xy, double yx, double yy);
vtkSmartPointer<vtkIdTypeArray> add_ids(vtkDataSetAttributes& to, std::string_view name, std::size_t tuples);

}  // namespace softgrain
