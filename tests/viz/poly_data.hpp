#pragma once
// Values of VTK data that was read back.
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkPolyData.h>

#include <stdexcept>
#include <string>

#include "common/vec.hpp"

namespace softgrain {

inline double value(vtkDataSetAttributes& data, const char* name, std::size_t tuple, int component = 0) {
    vtkDataArray* array = data.GetArray(name);
    if (array == nullptr) throw std::runtime_error(std::string("no array ") + name);
    return array->GetComponent(static_cast<vtkIdType>(tuple), component);
}

inline Vec2 point(vtkPolyData& data, vtkIdType id) {
    return {data.GetPoint(id)[0], data.GetPoint(id)[1]};
}

}  // namespace softgrain
