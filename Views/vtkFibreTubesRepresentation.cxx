// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFibreTubesRepresentation.h"

#include "DomainBox.h"
#include "ObliqueCamera.h"

#include <vtkAlgorithmOutput.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkMapper.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTrivialProducer.h>
#include <vtkTubeFilter.h>

vtkStandardNewMacro(vtkFibreTubesRepresentation);

namespace
{

/// Sides of a tube, so that a bundle of any size can be turned smoothly; 0: lines.
int sidesFor(vtkIdType points)
{
  return points <= 100000 ? 12 : points <= 400000 ? 6 : points <= 2000000 ? 4 : 0;
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
  if (fibres == nullptr || fibres->GetNumberOfLines() == 0 || fibres->GetPointData()->GetArray("Radius") == nullptr)
  {
    return input;
  }
  const int sides = sidesFor(fibres->GetNumberOfPoints());
  const vtkSmartPointer<vtkPolyData> shape = sides > 0 ? tubes(fibres, sides) : vtkSmartPointer<vtkPolyData>(fibres);
  this->Tubes->SetOutput(cactus::withDomainBox(shape, fibres->GetFieldData()));
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
  // What is no array of colours is mapped as ever.
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
