// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMLabelImageHelper.h"

#include <vtkObjectFactory.h>
#include <vtkSMArrayListDomain.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <cstring>

vtkStandardNewMacro(vtkSMLabelImageHelper);

vtkSMLabelImageHelper::vtkSMLabelImageHelper() = default;
vtkSMLabelImageHelper::~vtkSMLabelImageHelper() = default;

void vtkSMLabelImageHelper::PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType)
{
  vtkSMProperty* array = proxy->GetProperty("Array");
  auto* list = array != nullptr ? array->FindDomain<vtkSMArrayListDomain>() : nullptr;
  unsigned int place = 0;
  if (list != nullptr && std::strcmp(vtkSMPropertyHelper(array).GetAsString(), "Depth") == 0 &&
      list->IsInDomain("FibreId", place) != 0)
  {
    vtkSMPropertyHelper(array).Set("FibreId");
    proxy->UpdateVTKObjects();
  }
}

void vtkSMLabelImageHelper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
