// SPDX-License-Identifier: BSD-3-Clause
#include "ImageSections.h"

#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkImageDataGeometryFilter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <array>

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

vtkSmartPointer<vtkPolyData> smoothSlice(vtkImageData* image)
{
  vtkNew<vtkImageDataGeometryFilter> slice;
  slice->SetInputData(image);
  slice->SetExtent(middleOf(image).data());
  slice->Update();
  return slice->GetOutput();
}

/// Returns a slice in which each point of the image is a square, whose corners have the point's values.
vtkSmartPointer<vtkPolyData> sliceOfVoxels(vtkImageData* image)
{
  const std::array<int, 6> extent = middleOf(image);
  auto slice = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> corners;
  vtkNew<vtkCellArray> squares;
  slice->GetPointData()->CopyAllocate(image->GetPointData());
  for (int j = extent[2]; j <= extent[3]; ++j)
  {
    for (int i = extent[0]; i <= extent[1]; ++i)
    {
      int voxel[] = { i, j, extent[4] };
      const vtkIdType from = image->ComputePointId(voxel);
      squares->InsertNextCell(4);
      for (const auto& [x, y] : { std::array{ -0.5, -0.5 }, { 0.5, -0.5 }, { 0.5, 0.5 }, { -0.5, 0.5 } })
      {
        double place[3];
        image->TransformContinuousIndexToPhysicalPoint(i + x, j + y, extent[4], place);
        const vtkIdType to = corners->InsertNextPoint(place);
        slice->GetPointData()->CopyData(image->GetPointData(), from, to);
        squares->InsertCellPoint(to);
      }
    }
  }
  slice->SetPoints(corners);
  slice->SetPolys(squares);
  slice->GetFieldData()->PassData(image->GetFieldData());
  return slice;
}

vtkSmartPointer<vtkPolyData> middleSlice(vtkImageData* image)
{
  const bool isSmooth = isField(image) || image->GetPointData()->GetNumberOfArrays() == 0;
  return isSmooth ? smoothSlice(image) : sliceOfVoxels(image);
}

vtkSmartPointer<vtkPolyData> partInside(vtkPolyData* slice)
{
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(slice);
  clip->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, field);
  clip->SetValue(0.0);
  clip->Update();
  return clip->GetOutput();
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
