// SPDX-License-Identifier: BSD-3-Clause
#include "InputBlocks.h"

#include "base/Error.h"

#include <vtkAbstractArray.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>

namespace cactus
{

namespace
{

/// A data set and the name of its block, if any.
struct Leaf
{
  vtkDataObject* data;
  std::string label;
};

std::vector<Leaf> labelledLeaves(vtkDataObject* input)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (composite == nullptr)
  {
    return input != nullptr ? std::vector<Leaf>{ { input, "" } } : std::vector<Leaf>();
  }
  std::vector<Leaf> leaves;
  auto blocks = vtk::TakeSmartPointer(composite->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    const bool named = blocks->HasCurrentMetaData() != 0 && blocks->GetCurrentMetaData()->Has(vtkCompositeDataSet::NAME()) != 0;
    leaves.push_back(
      { blocks->GetCurrentDataObject(), named ? blocks->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME()) : "" });
  }
  return leaves;
}

} // namespace

std::vector<InputBlock> polyDataBlocks(vtkDataObject* input, const std::string& expected)
{
  const bool isComposite = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
  std::vector<InputBlock> blocks;
  std::size_t number = 0;
  for (const Leaf& leaf : labelledLeaves(input))
  {
    const std::string label = leaf.label.empty() ? "" : " (" + leaf.label + ")";
    const std::string name = isComposite ? "block " + std::to_string(++number) + label : "";
    auto* data = vtkPolyData::SafeDownCast(leaf.data);
    if (data == nullptr)
    {
      throw InvalidInput((name.empty() ? "the input" : name) + " is a " + leaf.data->GetClassName() + ": " + expected);
    }
    if (data->GetNumberOfCells() > 0)
    {
      blocks.push_back({ data, name });
    }
  }
  return blocks;
}

std::vector<vtkDataObject*> leavesOf(vtkDataObject* input)
{
  std::vector<vtkDataObject*> leaves;
  for (const Leaf& leaf : labelledLeaves(input))
  {
    leaves.push_back(leaf.data);
  }
  return leaves;
}

vtkAbstractArray* fieldArray(vtkDataObject* input, const char* name)
{
  std::vector<vtkDataObject*> places = leavesOf(input);
  places.insert(places.begin(), input);
  for (vtkDataObject* place : places)
  {
    if (place != nullptr && place->GetFieldData() != nullptr && place->GetFieldData()->GetAbstractArray(name) != nullptr)
    {
      return place->GetFieldData()->GetAbstractArray(name);
    }
  }
  return nullptr;
}

vtkMTimeType changeTime(vtkDataObject* input)
{
  vtkMTimeType newest = input != nullptr ? input->GetMTime() : 0;
  for (vtkDataObject* leaf : leavesOf(input))
  {
    newest = std::max(newest, leaf->GetMTime());
  }
  return newest;
}

} // namespace cactus
