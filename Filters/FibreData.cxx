// SPDX-License-Identifier: BSD-3-Clause
#include "FibreData.h"

#include "Error.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

/// A one-component array with as many tuples as there are things to describe, or null where there is none of that name.
vtkDataArray* scalars(vtkFieldData* data, const char* name, vtkIdType expected)
{
  vtkDataArray* array = data->GetArray(name);
  if (array != nullptr && (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != expected))
  {
    throw InvalidInput(std::string("array ") + name + " must have one component and " + std::to_string(expected) + " values");
  }
  return array;
}

} // namespace

Fibres fibresFrom(vtkPolyData* input)
{
  if (input == nullptr || input->GetNumberOfCells() == 0)
  {
    throw InvalidInput("the input holds no fibres: connect a BundleInitializer, a reader or polylines with a Radius array");
  }
  if (input->GetNumberOfLines() != input->GetNumberOfCells())
  {
    throw InvalidInput("the input holds cells that are not polylines: one polyline per fibre is expected");
  }
  vtkDataArray* radius = scalars(input->GetPointData(), "Radius", input->GetNumberOfPoints());
  if (radius == nullptr)
  {
    throw InvalidInput("the input has no point data array Radius (µm), so its fibres have no calibre");
  }
  vtkDataArray* fibreId = scalars(input->GetCellData(), "FibreId", input->GetNumberOfCells());
  vtkDataArray* bundleId = scalars(input->GetCellData(), "BundleId", input->GetNumberOfCells());
  vtkDataArray* targetRadius = scalars(input->GetCellData(), "TargetRadius", input->GetNumberOfCells());

  Fibres fibres;
  auto cells = vtk::TakeSmartPointer(input->GetLines()->NewIterator());
  vtkIdType cell = 0;
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell(), ++cell)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCurrentCell(count, ids);
    fibres.addFibre(fibreId ? static_cast<int>(fibreId->GetComponent(cell, 0)) : static_cast<int>(cell) + 1,
      bundleId ? static_cast<int>(bundleId->GetComponent(cell, 0)) : 1, 1.0);
    double sum = 0.0;
    for (vtkIdType i = 0; i < count; ++i)
    {
      Eigen::Vector3d point;
      input->GetPoint(ids[i], point.data());
      fibres.addPoint(point, radius->GetComponent(ids[i], 0));
      sum += fibres.radii.back();
    }
    fibres.targetRadii.back() =
      targetRadius ? targetRadius->GetComponent(cell, 0) : sum / static_cast<double>(std::max<vtkIdType>(count, 1));
  }
  if (hasDomain(input))
  {
    fibres.domain = domainFrom(input);
  }
  else
  {
    double bounds[6];
    input->GetBounds(bounds);
    fibres.domain.lower = Eigen::Vector3d(bounds[0], bounds[2], bounds[4]);
    fibres.domain.upper = Eigen::Vector3d(bounds[1], bounds[3], bounds[5]);
  }
  validate(fibres);
  return fibres;
}

void toPolyData(const Fibres& fibres, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(fibres.points.size()));
  vtkNew<vtkDoubleArray> radius;
  radius->SetName("Radius");
  radius->SetNumberOfValues(static_cast<vtkIdType>(fibres.points.size()));
  for (std::size_t i = 0; i < fibres.points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), fibres.points[i].data());
    radius->SetValue(static_cast<vtkIdType>(i), fibres.radii[i]);
  }
  const auto fibreCount = static_cast<vtkIdType>(fibres.size());
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIntArray> fibreId;
  fibreId->SetName("FibreId");
  fibreId->SetNumberOfValues(fibreCount);
  vtkNew<vtkIntArray> bundleId;
  bundleId->SetName("BundleId");
  bundleId->SetNumberOfValues(fibreCount);
  vtkNew<vtkDoubleArray> targetRadius;
  targetRadius->SetName("TargetRadius");
  targetRadius->SetNumberOfValues(fibreCount);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const auto id = static_cast<vtkIdType>(f);
    lines->InsertNextCell(static_cast<int>(fibres.pointCount(f)));
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      lines->InsertCellPoint(static_cast<vtkIdType>(i));
    }
    fibreId->SetValue(id, fibres.fibreIds[f]);
    bundleId->SetValue(id, fibres.bundleIds[f]);
    targetRadius->SetValue(id, fibres.targetRadii[f]);
  }
  vtkNew<vtkPolyData> fresh;
  fresh->SetPoints(points);
  fresh->SetLines(lines);
  fresh->GetPointData()->AddArray(radius);
  fresh->GetPointData()->SetActiveScalars("Radius");
  fresh->GetCellData()->AddArray(fibreId);
  fresh->GetCellData()->AddArray(bundleId);
  fresh->GetCellData()->AddArray(targetRadius);
  fresh->SetFieldData(output->GetFieldData());
  output->ShallowCopy(fresh);
  setDomain(output, fibres.domain);
}

bool hasDomain(vtkDataObject* data)
{
  return data->GetFieldData()->GetArray("Domain") != nullptr;
}

Domain domainFrom(vtkDataObject* data)
{
  vtkDataArray* array = data->GetFieldData()->GetArray("Domain");
  if (array == nullptr || array->GetNumberOfValues() != 6)
  {
    throw InvalidInput("the input has no field data Domain with six numbers (xmin xmax ymin ymax zmin zmax, µm)");
  }
  Domain domain;
  for (int axis = 0; axis < 3; ++axis)
  {
    domain.lower[axis] = array->GetVariantValue(2 * axis).ToDouble();
    domain.upper[axis] = array->GetVariantValue(2 * axis + 1).ToDouble();
  }
  if (!domain.lower.allFinite() || !domain.upper.allFinite() || domain.size().minCoeff() <= 0.0)
  {
    throw InvalidInput("field data Domain is empty or not finite: give xmin < xmax, ymin < ymax, zmin < zmax in µm");
  }
  return domain;
}

void setDomain(vtkDataObject* data, const Domain& domain)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Domain");
  array->SetNumberOfValues(6);
  for (int axis = 0; axis < 3; ++axis)
  {
    array->SetValue(2 * axis, domain.lower[axis]);
    array->SetValue(2 * axis + 1, domain.upper[axis]);
  }
  data->GetFieldData()->AddArray(array);
}

void addProvenance(vtkDataObject* from, vtkDataObject* to, const std::string& stage, const std::string& parameters)
{
  vtkNew<vtkStringArray> lines;
  lines->SetName("Provenance");
  if (from != nullptr)
  {
    if (auto* before = vtkStringArray::SafeDownCast(from->GetFieldData()->GetAbstractArray("Provenance")))
    {
      lines->DeepCopy(before);
    }
  }
  lines->InsertNextValue(stage + " " CACTUS_VERSION ": " + parameters);
  to->GetFieldData()->AddArray(lines);
}

} // namespace cactus
