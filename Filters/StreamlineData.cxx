// SPDX-License-Identifier: BSD-3-Clause
#include "StreamlineData.h"

#include "FibreData.h"
#include "InputBlocks.h"
#include "base/Error.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <string>
#include <vector>

namespace cactus
{

namespace
{

/// Adds the lines of one block.
void addStreamlines(vtkPolyData* input, Streamlines& streamlines)
{
  if (input->GetNumberOfLines() != input->GetNumberOfCells())
  {
    throw InvalidInput("the input holds cells that are not polylines: one polyline per streamline is expected");
  }
  const auto numbers = static_cast<std::size_t>(input->GetLines()->GetNumberOfConnectivityIds());
  streamlines.points.reserve(streamlines.points.size() + numbers);
  streamlines.offsets.reserve(streamlines.offsets.size() + static_cast<std::size_t>(input->GetNumberOfLines()));
  auto cells = vtk::TakeSmartPointer(input->GetLines()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCurrentCell(count, ids);
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (ids[i] < 0 || ids[i] >= input->GetNumberOfPoints())
      {
        throw InvalidInput(text("streamline ", streamlines.size() + 1, " names point ", ids[i], ", and there are ",
          input->GetNumberOfPoints(), " points: the polylines are damaged"));
      }
      Eigen::Vector3d point;
      input->GetPoint(ids[i], point.data());
      streamlines.points.push_back(point);
    }
    streamlines.offsets.push_back(streamlines.points.size());
  }
}

/// Returns the cell data BundleId of a block with a value for each cell; null if there are none.
vtkDataArray* bundlesOf(vtkPolyData* input)
{
  vtkDataArray* array = input->GetCellData()->GetArray("BundleId");
  if (array != nullptr && (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != input->GetNumberOfCells()))
  {
    throw InvalidInput(text("array BundleId must have one component and ", input->GetNumberOfCells(), " values"));
  }
  return array;
}

} // namespace

Streamlines streamlinesFrom(vtkDataObject* input)
{
  const auto blocks = polyDataBlocks(input, "streamlines are polylines (vtkPolyData)");
  const bool haveBundles =
    std::all_of(blocks.begin(), blocks.end(), [](const InputBlock& block) { return bundlesOf(block.data) != nullptr; });
  Streamlines streamlines;
  for (const InputBlock& block : blocks)
  {
    try
    {
      addStreamlines(block.data, streamlines);
      for (vtkIdType cell = 0; haveBundles && cell < block.data->GetNumberOfCells(); ++cell)
      {
        streamlines.bundleIds.push_back(idFrom(bundlesOf(block.data), cell));
      }
    }
    catch (const InvalidInput& error)
    {
      throw InvalidInput((block.name.empty() ? "" : block.name + ": ") + error.what());
    }
  }
  validate(streamlines);
  return streamlines;
}

} // namespace cactus
