// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSubstrateDataDomain.h"

#include <vtkDataObject.h>
#include <vtkObjectFactory.h>
#include <vtkPVDataInformation.h>
#include <vtkPVXMLElement.h>
#include <vtkSMInputProperty.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMUncheckedPropertyHelper.h>

#include <algorithm>
#include <sstream>

vtkStandardNewMacro(vtkSMSubstrateDataDomain);

namespace
{

bool has(vtkPVDataInformation* data, int association, const char* name)
{
  return data->GetArrayInformation(name, association) != nullptr;
}

bool isOf(const std::string& kind, vtkPVDataInformation* data)
{
  const bool fibres = has(data, vtkDataObject::POINT, "Radius");
  if (kind == "fibres")
  {
    return fibres;
  }
  const bool streamlines = has(data, vtkDataObject::POINT, "Direction"); // surfaces have it as cell data
  if (kind == "streamlines")
  {
    return fibres || streamlines;
  }
  const bool surfaces =
    !fibres && !streamlines && (has(data, vtkDataObject::CELL, "FibreId") || has(data, vtkDataObject::FIELD, "FibreId"));
  if (kind == "surfaces" || kind == "lines")
  {
    return surfaces == (kind == "surfaces");
  }
  return has(data, vtkDataObject::POINT, "FibreId") && has(data, vtkDataObject::POINT, "Depth");
}

} // namespace

vtkSMSubstrateDataDomain::vtkSMSubstrateDataDomain() = default;
vtkSMSubstrateDataDomain::~vtkSMSubstrateDataDomain() = default;

int vtkSMSubstrateDataDomain::IsInDomain(vtkSMProperty* property)
{
  auto* first = vtkSMInputProperty::SafeDownCast(this->GetRequiredProperty("First"));
  if (first != nullptr && first->GetNumberOfProxies() == 0)
  {
    vtkSMDomain* ofFirst = first->FindDomain(this->GetClassName());
    return ofFirst != nullptr ? ofFirst->IsInDomain(property) : IN_DOMAIN;
  }
  vtkSMUncheckedPropertyHelper inputs(property);
  for (unsigned int i = 0; i < inputs.GetNumberOfElements(); ++i)
  {
    auto* source = vtkSMSourceProxy::SafeDownCast(inputs.GetAsProxy(i));
    if (source == nullptr)
    {
      return NOT_IN_DOMAIN;
    }
    source->CreateOutputPorts();
    vtkPVDataInformation* data = source->GetDataInformation(inputs.GetOutputPort(i));
    if (data == nullptr ||
        std::none_of(this->Kinds.begin(), this->Kinds.end(), [&](const std::string& kind) { return isOf(kind, data); }))
    {
      return NOT_IN_DOMAIN;
    }
  }
  return IN_DOMAIN;
}

int vtkSMSubstrateDataDomain::ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element)
{
  if (!this->Superclass::ReadXMLAttributes(property, element))
  {
    return 0;
  }
  std::istringstream kinds(element->GetAttributeOrEmpty("kinds"));
  for (std::string kind; kinds >> kind;)
  {
    if (kind != "fibres" && kind != "surfaces" && kind != "labels" && kind != "lines" && kind != "streamlines")
    {
      vtkErrorMacro("there is no kind '" << kind << "': fibres, surfaces, labels, lines or streamlines");
      return 0;
    }
    this->Kinds.push_back(kind);
  }
  return this->Kinds.empty() ? 0 : 1;
}

void vtkSMSubstrateDataDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const std::string& kind : this->Kinds)
  {
    os << indent << "Kind: " << kind << '\n';
  }
}
