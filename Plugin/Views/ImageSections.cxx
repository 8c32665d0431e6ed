// SPDX-License-Identifier: BSD-3-Clause
#include "ImageSections.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkClipPolyData.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkImageDataGeometryFilter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace cactus
{
namespace
{

constexpr char field[] = "Field";

bool isField(vtkImageData* image)
{
  return image->GetPointData()->GetArray(field) != nullptr;
}

/// Returns the extent of the middle slice, which is cut across the third axis.
std::array<int, 6> middleOf(vtkImageData* image)
{
  std::array<int, 6> extent;
  image->GetExtent(extent.data());
  extent[4] = extent[5] = extent[4] + (extent[5] - extent[4]) / 2;
  return extent;
}

constexpr char pointIds[] = "vtkOriginalPointIds";
constexpr char cellIds[] = "vtkOriginalCellIds";

/// Adds numbers of points or cells of the image, by which ParaView selects and picks.
void addIds(vtkDataSetAttributes* data, const char* name, vtkIdTypeArray* ids)
{
  ids->SetName(name);
  data->AddArray(ids);
}

/// Returns the number of the image's cell that begins at a point or, at an upper face, ends there; -1 in an image without cells.
vtkIdType cellAt(vtkImageData* image, std::array<int, 3> voxel)
{
  const int* extent = image->GetExtent();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    voxel[axis] = std::min(voxel[axis], extent[2 * axis + 1] - 1);
    if (voxel[axis] < extent[2 * axis])
    {
      return -1;
    }
  }
  return image->ComputeCellId(voxel.data());
}

/// Returns a slice as it is.
vtkSmartPointer<vtkPolyData> smoothSlice(vtkImageData* image)
{
  std::array<int, 6> extent = middleOf(image);
  const int* whole = image->GetExtent();
  for (std::size_t side = 0; side < 6; ++side)
  {
    extent[side] -= whole[side / 2 * 2]; // as the filter counts
  }
  vtkNew<vtkImageDataGeometryFilter> filter;
  filter->SetInputData(image);
  filter->SetExtent(extent.data());
  filter->Update();
  vtkSmartPointer<vtkPolyData> slice = filter->GetOutput();
  const std::array<int, 6> middle = middleOf(image);
  vtkNew<vtkIdTypeArray> points;
  vtkNew<vtkIdTypeArray> cells;
  for (int j = middle[2]; j <= middle[3]; ++j)
  {
    for (int i = middle[0]; i <= middle[1]; ++i)
    {
      int voxel[] = { i, j, middle[4] };
      points->InsertNextValue(image->ComputePointId(voxel));
      if (i < middle[1] && j < middle[3])
      {
        cells->InsertNextValue(cellAt(image, { i, j, middle[4] }));
      }
    }
  }
  addIds(slice->GetPointData(), pointIds, points);
  addIds(slice->GetCellData(), cellIds, cells);
  return slice;
}

/// Returns a slice in which each point of the image is a square, whose corners have the point's values.
vtkSmartPointer<vtkPolyData> sliceOfVoxels(vtkImageData* image)
{
  const std::array<int, 6> extent = middleOf(image);
  auto slice = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> corners;
  vtkNew<vtkCellArray> squares;
  vtkNew<vtkIdTypeArray> points;
  vtkNew<vtkIdTypeArray> cells;
  slice->GetPointData()->CopyAllocate(image->GetPointData());
  for (int j = extent[2]; j <= extent[3]; ++j)
  {
    for (int i = extent[0]; i <= extent[1]; ++i)
    {
      int voxel[] = { i, j, extent[4] };
      const vtkIdType from = image->ComputePointId(voxel);
      squares->InsertNextCell(4);
      cells->InsertNextValue(cellAt(image, { i, j, extent[4] }));
      for (const auto& [x, y] : { std::array{ -0.5, -0.5 }, { 0.5, -0.5 }, { 0.5, 0.5 }, { -0.5, 0.5 } })
      {
        double place[3];
        image->TransformContinuousIndexToPhysicalPoint(i + x, j + y, extent[4], place);
        const vtkIdType to = corners->InsertNextPoint(place);
        slice->GetPointData()->CopyData(image->GetPointData(), from, to);
        squares->InsertCellPoint(to);
        points->InsertNextValue(from);
      }
    }
  }
  slice->SetPoints(corners);
  slice->SetPolys(squares);
  slice->GetFieldData()->PassData(image->GetFieldData());
  addIds(slice->GetPointData(), pointIds, points);
  addIds(slice->GetCellData(), cellIds, cells);
  return slice;
}

vtkSmartPointer<vtkPolyData> middleSlice(vtkImageData* image)
{
  const bool isSmooth = isField(image) || image->GetCellData()->GetNumberOfArrays() > 0 || image->GetNumberOfPoints() == 0;
  return isSmooth ? smoothSlice(image) : sliceOfVoxels(image);
}

vtkSmartPointer<vtkPolyData> partInside(vtkPolyData* slice)
{
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(slice);
  clip->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, field);
  clip->SetValue(0.0);
  clip->Update();
  vtkSmartPointer<vtkPolyData> part = clip->GetOutput();
  vtkNew<vtkIdTypeArray> none; // new points are between two
  none->SetNumberOfValues(part->GetNumberOfPoints());
  none->FillValue(-1);
  addIds(part->GetPointData(), pointIds, none);
  return part;
}

} // namespace

vtkSmartPointer<vtkDataObject> imageSections(vtkDataObject* data)
{
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    return middleSlice(image);
  }
  auto* blocks = vtkDataObjectTree::SafeDownCast(data);
  if (blocks == nullptr)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkDataObjectTree> sections = vtk::TakeSmartPointer(blocks->NewInstance());
  sections->CopyStructure(blocks);
  vtkSmartPointer<vtkDataObjectTreeIterator> one = vtk::TakeSmartPointer(blocks->NewTreeIterator());
  int images = 0;
  for (one->InitTraversal(); !one->IsDoneWithTraversal(); one->GoToNextItem())
  {
    images += vtkImageData::SafeDownCast(one->GetCurrentDataObject()) != nullptr ? 1 : 0;
  }
  for (one->InitTraversal(); !one->IsDoneWithTraversal(); one->GoToNextItem())
  {
    vtkDataObject* block = one->GetCurrentDataObject();
    if (auto* image = vtkImageData::SafeDownCast(block))
    {
      const vtkSmartPointer<vtkPolyData> slice = middleSlice(image);
      sections->SetDataSetFrom(one, images > 1 && isField(image) ? partInside(slice) : slice);
    }
    else
    {
      sections->SetDataSetFrom(one, block);
    }
  }
  return images > 0 ? sections : nullptr;
}

} // namespace cactus
