// SPDX-License-Identifier: BSD-3-Clause
#include "DomainBox.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

namespace cactus
{

namespace
{

constexpr int corners = 8;
constexpr int edges = 12;
constexpr double grey = 128.0;

/// Puts `count` tuples like the first one at `begin`, and grey into arrays of colours.
void repeatFirst(vtkDataSetAttributes* from, vtkDataSetAttributes* to, vtkIdType begin, vtkIdType count)
{
  for (vtkIdType i = 0; i < count; ++i)
  {
    to->CopyData(from, vtkIdType(0), begin + i);
  }
  for (int a = 0; a < to->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* colours = vtkUnsignedCharArray::SafeDownCast(to->GetArray(a));
    for (vtkIdType i = 0; colours != nullptr && i < count; ++i)
    {
      for (int component = 0; component < colours->GetNumberOfComponents(); ++component)
      {
        colours->SetComponent(begin + i, component, grey);
      }
    }
  }
}

/// Copies all tuples of `from` to `begin`.
void copyAll(vtkDataSetAttributes* from, vtkDataSetAttributes* to, vtkIdType begin, vtkIdType count)
{
  to->CopyData(from, begin, count, 0);
}

} // namespace

vtkSmartPointer<vtkMatrix4x4> placementIn(vtkFieldData* facts)
{
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  vtkDataArray* numbers = facts->GetArray("Placement");
  for (int i = 0; numbers != nullptr && numbers->GetNumberOfValues() == 16 && i < 16; ++i)
  {
    matrix->SetElement(i / 4, i % 4, numbers->GetVariantValue(i).ToDouble());
  }
  return matrix;
}

vtkSmartPointer<vtkPolyData> withDomainBox(vtkPolyData* shape, vtkFieldData* facts)
{
  vtkDataArray* domain = facts != nullptr ? facts->GetArray("Domain") : nullptr;
  const vtkIdType pointCount = shape->GetNumberOfPoints();
  const vtkIdType cellCount = shape->GetNumberOfCells();
  if (domain == nullptr || domain->GetNumberOfValues() != 6 || cellCount == 0 || shape->GetNumberOfVerts() > 0)
  {
    return shape;
  }
  vtkNew<vtkPolyData> boxed;
  vtkNew<vtkPoints> points;
  points->SetDataType(shape->GetPoints()->GetDataType());
  points->SetNumberOfPoints(pointCount + corners);
  points->InsertPoints(0, pointCount, 0, shape->GetPoints());
  const vtkSmartPointer<vtkMatrix4x4> placement = placementIn(facts);
  const auto side = [&](int corner, int axis) { return domain->GetVariantValue(2 * axis + (corner >> axis & 1)).ToDouble(); };
  for (int corner = 0; corner < corners; ++corner)
  {
    const double place[4] = { side(corner, 0), side(corner, 1), side(corner, 2), 1.0 };
    points->SetPoint(pointCount + corner, placement->MultiplyDoublePoint(place));
  }
  boxed->SetPoints(points);

  // Lines come before polygons and strips: the box's lines first of all.
  vtkNew<vtkCellArray> lines;
  for (int corner = 0; corner < corners; ++corner)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if ((corner >> axis & 1) == 0)
      {
        const vtkIdType edge[2] = { pointCount + corner, pointCount + (corner | 1 << axis) };
        lines->InsertNextCell(2, edge);
      }
    }
  }
  lines->Append(shape->GetLines(), 0);
  boxed->SetLines(lines);
  boxed->SetPolys(shape->GetPolys());
  boxed->SetStrips(shape->GetStrips());

  vtkPointData* pointData = boxed->GetPointData();
  pointData->CopyAllOn();
  pointData->CopyAllocate(shape->GetPointData(), pointCount + corners);
  copyAll(shape->GetPointData(), pointData, 0, pointCount);
  repeatFirst(shape->GetPointData(), pointData, pointCount, corners);
  vtkCellData* cellData = boxed->GetCellData();
  cellData->CopyAllOn();
  cellData->CopyAllocate(shape->GetCellData(), cellCount + edges);
  repeatFirst(shape->GetCellData(), cellData, 0, edges);
  copyAll(shape->GetCellData(), cellData, edges, cellCount);
  boxed->SetFieldData(shape->GetFieldData());
  return boxed;
}

} // namespace cactus
