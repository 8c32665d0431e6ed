// SPDX-License-Identifier: BSD-3-Clause
#include "Columns.h"

#include <cstdlib>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace cactus
{

namespace
{

/// The vectors whose memory VTK arrays use, by address: VTK's deleter gets only the address.
template <typename Value>
class Adopted
{
public:
  static Value* keep(std::vector<Value> values)
  {
    const std::lock_guard<std::mutex> lock(mutex());
    Value* begin = values.data();
    kept().emplace(begin, std::move(values));
    return begin;
  }

  /// Called with the array's final memory, which is VTK's own if the array was enlarged.
  static void release(void* begin)
  {
    const std::lock_guard<std::mutex> lock(mutex());
    if (kept().erase(begin) == 0)
    {
      std::free(begin);
    }
  }

private:
  // Neither is ever destroyed: arrays may be released while the process ends.
  static std::mutex& mutex()
  {
    static auto* one = new std::mutex;
    return *one;
  }

  static std::unordered_map<void*, std::vector<Value>>& kept()
  {
    static auto* all = new std::unordered_map<void*, std::vector<Value>>;
    return *all;
  }
};

/// `Number` is VTK's type for `Value`, with the same bits.
template <typename Array, typename Value>
vtkSmartPointer<Array> adopted(const std::string& name, std::vector<Value> values, int components)
{
  using Number = typename Array::ValueType;
  static_assert(sizeof(Number) == sizeof(Value));
  if (values.empty())
  {
    return makeArray<Array>(name, 0, components);
  }
  const auto count = static_cast<vtkIdType>(values.size());
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetArray(
    reinterpret_cast<Number*>(Adopted<Value>::keep(std::move(values))), count, 0, vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
  array->SetArrayFreeFunction(&Adopted<Value>::release);
  return array;
}

} // namespace

vtkSmartPointer<vtkDoubleArray> adoptedArray(const std::string& name, std::vector<double> values, int components)
{
  return adopted<vtkDoubleArray>(name, std::move(values), components);
}

vtkSmartPointer<vtkTypeInt64Array> adoptedArray(const std::string& name, std::vector<std::size_t> values)
{
  return adopted<vtkTypeInt64Array>(name, std::move(values), 1);
}

} // namespace cactus
