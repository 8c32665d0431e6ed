// SPDX-License-Identifier: BSD-3-Clause
#include "LiftedCaps.h"

#include "DomainBox.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>

namespace cactus
{

namespace
{

/// Largest depth of caps inside a face, as a fraction of the domain's side, and the distance outside at which they are drawn.
constexpr double depth = 0.05;
constexpr double lift = 1e-3;
constexpr double rounding = 1e-6;

/// Moves the points whose coordinate equals `from`, up to rounding, to `to`.
void move(vtkDataArray* coordinates, int axis, double from, double to)
{
  for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
  {
    if (std::abs(coordinates->GetComponent(i, axis) - from) < rounding * std::abs(to))
    {
      coordinates->SetComponent(i, axis, to);
    }
  }
}

/// Returns a copy of points, transformed by an affine.
vtkSmartPointer<vtkPoints> moved(vtkPoints* points, vtkMatrix4x4* affine)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataType(points->GetDataType());
  result->DeepCopy(points);
  for (vtkIdType i = 0; affine->IsIdentity() == 0 && i < points->GetNumberOfPoints(); ++i)
  {
    double place[4] = { 0.0, 0.0, 0.0, 1.0 };
    points->GetPoint(i, place);
    result->SetPoint(i, affine->MultiplyDoublePoint(place));
  }
  result->Modified();
  return result;
}

} // namespace

vtkSmartPointer<vtkPolyData> withLiftedCaps(vtkPolyData* surface)
{
  vtkDataArray* domain = surface->GetFieldData()->GetArray("Domain");
  if (domain == nullptr || domain->GetNumberOfValues() != 6 || surface->GetNumberOfPoints() == 0)
  {
    return surface;
  }
  const vtkSmartPointer<vtkMatrix4x4> placement = placementIn(surface->GetFieldData());
  vtkNew<vtkMatrix4x4> back;
  vtkMatrix4x4::Invert(placement, back);
  const vtkSmartPointer<vtkPoints> points = moved(surface->GetPoints(), back);
  double bounds[6];
  points->GetBounds(bounds);
  for (int end = 0; end < 6; ++end)
  {
    const double face = domain->GetVariantValue(end).ToDouble();
    const double inward = domain->GetVariantValue(end ^ 1).ToDouble() - face;
    if (std::abs(bounds[end] - face) < depth * std::abs(inward))
    {
      move(points->GetData(), end / 2, bounds[end], face - lift * inward);
    }
  }
  auto lifted = vtkSmartPointer<vtkPolyData>::New();
  lifted->ShallowCopy(surface);
  lifted->SetPoints(moved(points, placement));
  return lifted;
}

} // namespace cactus
