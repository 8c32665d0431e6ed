// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFibreSurfaceRepresentation.h"

#include "LiftedCaps.h"
#include "ObliqueCamera.h"

#include <vtkAlgorithmOutput.h>
#include <vtkMapper.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkTrivialProducer.h>

#include <string>

vtkStandardNewMacro(vtkFibreSurfaceRepresentation);

vtkFibreSurfaceRepresentation::vtkFibreSurfaceRepresentation() = default;
vtkFibreSurfaceRepresentation::~vtkFibreSurfaceRepresentation() = default;

vtkAlgorithmOutput* vtkFibreSurfaceRepresentation::GetInternalOutputPort(int port, int connection)
{
  vtkAlgorithmOutput* input = this->Superclass::GetInternalOutputPort(port, connection);
  auto* surface = vtkPolyData::SafeDownCast(input->GetProducer()->GetOutputDataObject(input->GetIndex()));
  if (surface == nullptr || !this->LiftCaps)
  {
    return input;
  }
  this->Lifted->SetOutput(cactus::withLiftedCaps(surface));
  return this->Lifted->GetOutputPort();
}

bool vtkFibreSurfaceRepresentation::AddToView(vtkView* view)
{
  cactus::lookObliquely(view);
  return this->Superclass::AddToView(view);
}

void vtkFibreSurfaceRepresentation::UpdateColoringParameters()
{
  this->Superclass::UpdateColoringParameters();
  for (vtkMapper* mapper : { this->Mapper, this->LODMapper })
  {
    if (mapper->GetScalarVisibility() && std::string(mapper->GetArrayName()) == "Direction")
    {
      mapper->SetColorModeToDirectScalars(); // they are colours
    }
  }
}

void vtkFibreSurfaceRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LiftCaps: " << this->LiftCaps << '\n';
}
