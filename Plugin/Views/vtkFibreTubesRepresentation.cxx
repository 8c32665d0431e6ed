// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFibreTubesRepresentation.h"

#include "DomainBox.h"
#include "ObliqueCamera.h"

#include <vtkAlgorithmOutput.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkMapper.h>
#include <vtkObjectFactory.h>
#include <vtkPVGeometryFilter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTrivialProducer.h>
#include <vtkTubeFilter.h>

#include <numeric>

vtkStandardNewMacro(vtkFibreTubesRepresentation);

namespace
{

/// Returns the sides of a tube, so that a bundle of any size rotates smoothly; 0: lines.
int sidesFor(vtkIdType points)
{
  return points <= 100000 ? 12 : points <= 400000 ? 6 : points <= 2000000 ? 4 : 0;
}

constexpr const char* cellIds = "vtkOriginalCellIds";
constexpr const char* pointIds = "vtkOriginalPointIds";

void addIds(vtkDataSetAttributes* data, const char* name, vtkIdType count)
{
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(name);
  ids->SetNumberOfValues(count);
  std::iota(ids->GetPointer(0), ids->GetPointer(0) + count, vtkIdType(0));
  data->AddArray(ids);
}

/// Adds the original numbers of cells and points, for selections: those of the drawn data differ.
vtkSmartPointer<vtkPolyData> withIds(vtkPolyData* fibres)
{
  auto numbered = vtkSmartPointer<vtkPolyData>::New();
  numbered->ShallowCopy(fibres);
  addIds(numbered->GetCellData(), cellIds, fibres->GetNumberOfCells());
  addIds(numbered->GetPointData(), pointIds, fibres->GetNumberOfPoints());
  return numbered;
}

/// Removes ids, so that what is drawn around the fibres cannot be selected as one of them.
void forgetIds(vtkDataSetAttributes* data, const char* name, vtkIdType first, vtkIdType count)
{
  auto* ids = vtkIdTypeArray::SafeDownCast(data->GetArray(name));
  for (vtkIdType i = 0; ids != nullptr && i < count; ++i)
  {
    ids->SetValue(first + i, -1);
  }
}

vtkSmartPointer<vtkPolyData> tubes(vtkPolyData* fibres, int sides)
{
  vtkNew<vtkTubeFilter> filter;
  filter->SetInputData(fibres);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Radius");
  filter->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  filter->SetNumberOfSides(sides);
  filter->CappingOn();
  filter->Update();
  return filter->GetOutput();
}

} // namespace

vtkFibreTubesRepresentation::vtkFibreTubesRepresentation() = default;
vtkFibreTubesRepresentation::~vtkFibreTubesRepresentation() = default;

vtkAlgorithmOutput* vtkFibreTubesRepresentation::GetInternalOutputPort(int port, int connection)
{
  vtkAlgorithmOutput* input = this->Superclass::GetInternalOutputPort(port, connection);
  auto* fibres = vtkPolyData::SafeDownCast(input->GetProducer()->GetOutputDataObject(input->GetIndex()));
  const bool isFibres =
    fibres != nullptr && fibres->GetNumberOfLines() > 0 && fibres->GetPointData()->GetArray("Radius") != nullptr;
  if (auto* geometry = vtkPVGeometryFilter::SafeDownCast(this->GeometryFilter))
  {
    geometry->SetPassThroughCellIds(isFibres ? 0 : 1); // otherwise the filter numbers the drawn data
    geometry->SetPassThroughPointIds(isFibres ? 0 : 1);
  }
  if (!isFibres)
  {
    return input;
  }
  const vtkSmartPointer<vtkPolyData> numbered = withIds(fibres);
  const int sides = sidesFor(fibres->GetNumberOfPoints());
  const vtkSmartPointer<vtkPolyData> shape = sides > 0 ? tubes(numbered, sides) : numbered;
  const vtkSmartPointer<vtkPolyData> boxed = cactus::withDomainBox(shape, fibres->GetFieldData());
  forgetIds(boxed->GetCellData(), cellIds, 0, boxed->GetNumberOfCells() - shape->GetNumberOfCells());
  const vtkIdType drawn = shape->GetNumberOfPoints();
  forgetIds(boxed->GetPointData(), pointIds, drawn, boxed->GetNumberOfPoints() - drawn);
  this->Tubes->SetOutput(boxed);
  return this->Tubes->GetOutputPort();
}

bool vtkFibreTubesRepresentation::AddToView(vtkView* view)
{
  cactus::lookObliquely(view);
  return this->Superclass::AddToView(view);
}

void vtkFibreTubesRepresentation::UpdateColoringParameters()
{
  this->Superclass::UpdateColoringParameters();
  // Other arrays are mapped as usual.
  for (vtkMapper* mapper : { this->Mapper, this->LODMapper })
  {
    mapper->SetColorModeToDefault();
    if (this->DirectionColors && !mapper->GetScalarVisibility())
    {
      mapper->ScalarVisibilityOn();
      mapper->SetScalarModeToUsePointFieldData();
      mapper->SelectColorArray("Direction");
    }
  }
}

void vtkFibreTubesRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DirectionColors: " << this->DirectionColors << '\n';
}
