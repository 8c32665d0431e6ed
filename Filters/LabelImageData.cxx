// SPDX-License-Identifier: BSD-3-Clause
#include "LabelImageData.h"

#include "FibreData.h"
#include "PlacementData.h"
#include "base/Error.h"
#include "base/Limits.h"

#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>

#include <cmath>
#include <string>
#include <vector>

namespace cactus
{

namespace
{

constexpr const char* advice = ": give the output of FibreRadialGrowth";

vtkDataArray* fieldColumn(vtkImageData* image, const std::string& name)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(name.c_str());
  if (array == nullptr || array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() < 1)
  {
    throw InvalidInput("the label image has no field data " + name + advice);
  }
  return array;
}

double fieldNumber(vtkImageData* image, const std::string& name)
{
  return fieldColumn(image, name)->GetComponent(0, 0);
}

std::vector<double> fieldValues(vtkImageData* image, const std::string& name)
{
  vtkDataArray* array = fieldColumn(image, name);
  std::vector<double> values;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    values.push_back(array->GetComponent(i, 0));
    if (!(values.back() >= 0.0 && values.back() <= limits::coordinate.highest))
    {
      throw InvalidInput(text("the label image's field data ", name, " holds ", values.back(), advice));
    }
  }
  return values;
}

std::vector<int> fieldIds(vtkImageData* image, const std::string& name)
{
  vtkDataArray* array = fieldColumn(image, name);
  std::vector<int> ids;
  for (vtkIdType row = 0; row < array->GetNumberOfTuples(); ++row)
  {
    ids.push_back(idFrom(array, row));
  }
  return ids;
}

/// Returns a view of the image's arrays in VTK.
LabelImageView viewOf(vtkImageData* image)
{
  auto* fibreId = vtkIntArray::SafeDownCast(image->GetPointData()->GetArray("FibreId"));
  auto* depth = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("Depth"));
  const vtkIdType points = image->GetNumberOfPoints();
  if (fibreId == nullptr || fibreId->GetNumberOfComponents() != 1 || fibreId->GetNumberOfTuples() != points)
  {
    throw InvalidInput(std::string("the label image has no point data FibreId of 32-bit integers") + advice);
  }
  if (depth == nullptr || depth->GetNumberOfComponents() != 1 || depth->GetNumberOfTuples() != points)
  {
    throw InvalidInput(std::string("the label image has no point data Depth of 32-bit floating point numbers") + advice);
  }
  LabelImageView view;
  const double* spacing = image->GetSpacing();
  if (!std::isfinite(spacing[0]) || spacing[0] <= 0.0 || !Eigen::Vector3d(image->GetOrigin()).allFinite())
  {
    throw InvalidInput("the label image's Spacing or Origin is no length in µm: give the output of FibreRadialGrowth");
  }
  if (std::abs(spacing[1] - spacing[0]) > 1e-9 * spacing[0] || std::abs(spacing[2] - spacing[0]) > 1e-9 * spacing[0])
  {
    throw InvalidInput("the label image's voxels are no cubes: resample it, or use the output of FibreRadialGrowth");
  }
  const double* direction = image->GetDirectionMatrix()->GetData();
  for (int i = 0; i < 9; ++i)
  {
    if (direction[i] != (i % 4 == 0 ? 1.0 : 0.0))
    {
      throw InvalidInput("the label image is turned (Direction): only images along the axes can be contoured");
    }
  }
  view.grid.spacing = spacing[0];
  view.grid.origin = Eigen::Vector3d(image->GetOrigin());
  const int* extent = image->GetExtent();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    view.grid.lower[axis] = extent[2 * axis];
    view.grid.count[axis] = extent[2 * axis + 1] - extent[2 * axis] + 1;
  }
  view.fibreId = fibreId->GetPointer(0);
  view.depth = depth->GetPointer(0);
  return view;
}

} // namespace

vtkImageData* requireImage(vtkDataObject* input)
{
  auto* image = vtkImageData::SafeDownCast(input);
  if (input != nullptr && image == nullptr)
  {
    const bool isComposite = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
    throw InvalidInput(std::string("the input is a ") + input->GetClassName() + ", and one label image is expected" +
                       (isComposite ? ": group fibres before FibreRadialGrowth, not images after it" : advice));
  }
  if (image == nullptr || image->GetNumberOfPoints() == 0)
  {
    throw InvalidInput(std::string("the label image is empty") + advice);
  }
  requireNotPlaced(image);
  return image;
}

LabelImageInput labelImageFrom(vtkDataObject* input)
{
  LabelImageInput result;
  result.image = requireImage(input);
  vtkImageData* image = result.image;
  LabelImageView& view = result.view;
  view = viewOf(image);
  LabelImageFacts& facts = result.facts;
  facts.domain = domainFrom(image);
  facts.minimumGap = fieldNumber(image, "MinimumGap");
  facts.surfaceTolerance = fieldNumber(image, "SurfaceTolerance");
  facts.fibreIds = fieldIds(image, "FibreTable.FibreId");
  facts.bundleIds = fieldIds(image, "FibreTable.BundleId");
  facts.targetRadii = fieldValues(image, "FibreTable.TargetRadius");
  for (const ColumnFacts& column : fibreColumns())
  {
    const std::string name = std::string("FibreTable.") + column.name;
    vtkDataArray* array = image->GetFieldData()->HasArray(name.c_str()) != 0 ? fieldColumn(image, name) : nullptr;
    for (vtkIdType row = 0; array != nullptr && row < array->GetNumberOfTuples(); ++row)
    {
      facts.columns.set(column.name, static_cast<std::size_t>(row), array->GetComponent(row, 0));
    }
  }
  if (image->GetFieldData()->HasArray("FibreTable.LengthInDomain"))
  {
    facts.lengths = fieldValues(image, "FibreTable.LengthInDomain");
  }
  view.gap = facts.minimumGap + 2.0 * facts.surfaceTolerance;
  return result;
}

} // namespace cactus
