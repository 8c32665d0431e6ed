// SPDX-License-Identifier: BSD-3-Clause
// Arrays for outputs: the columns of tables, and the tables in field data.
#pragma once

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

namespace cactus
{

/// Makes an array of `count` tuples without values. Throws std::bad_alloc if they do not fit into memory, without an error
/// message: VTK's own allocation would report an error, or end the program (Debian builds it with assertions).
template <typename Array>
vtkSmartPointer<Array> makeArray(const std::string& name, std::size_t count, int components = 1)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  if constexpr (std::is_base_of_v<vtkDataArray, Array>)
  {
    using Value = typename Array::ValueType;
    const std::size_t values = count * static_cast<std::size_t>(components);
    array->SetNumberOfComponents(components);
    array->SetArray(new Value[values], static_cast<vtkIdType>(values), 0, vtkAbstractArray::VTK_DATA_ARRAY_DELETE);
  }
  else
  {
    array->SetNumberOfValues(static_cast<vtkIdType>(count));
  }
  return array;
}

/// Makes an array of these values without copying them.
vtkSmartPointer<vtkDoubleArray> adoptedArray(const std::string& name, std::vector<double> values, int components = 1);

/// Does the same for whole numbers of 64 bits, each below 2⁶³.
vtkSmartPointer<vtkTypeInt64Array> adoptedArray(const std::string& name, std::vector<std::size_t> values);

inline void store(vtkTable* table, vtkAbstractArray* column)
{
  table->AddColumn(column);
}

inline void store(vtkFieldData* data, vtkAbstractArray* column)
{
  data->AddArray(column);
}

/// Adds a column with the values value(0), …, value(rows - 1) to a table, or to field data.
template <typename Array, typename Target, typename Value>
void addColumn(Target* target, const std::string& name, std::size_t rows, Value&& value)
{
  auto column = makeArray<Array>(name, rows);
  for (std::size_t row = 0; row < rows; ++row)
  {
    if constexpr (std::is_base_of_v<vtkDataArray, Array>)
    {
      column->SetValue(static_cast<vtkIdType>(row), static_cast<typename Array::ValueType>(value(row)));
    }
    else
    {
      column->SetValue(static_cast<vtkIdType>(row), value(row)); // text
    }
  }
  store(target, column);
}

/// Adds one number as field data.
inline void addNumber(vtkFieldData* data, const std::string& name, double value)
{
  addColumn<vtkDoubleArray>(data, name, 1, [value](std::size_t) { return value; });
}

/// Adds one whole number as field data.
inline void addCount(vtkFieldData* data, const std::string& name, int value)
{
  addColumn<vtkIntArray>(data, name, 1, [value](std::size_t) { return value; });
}

} // namespace cactus
