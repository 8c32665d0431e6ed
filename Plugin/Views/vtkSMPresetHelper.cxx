// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMPresetHelper.h"

#include "vtkSMPresetDomain.h"

#include <vtkObjectFactory.h>
#include <vtkSMProxy.h>

#include <set>

vtkStandardNewMacro(vtkSMPresetHelper);

namespace
{

/// Collects the presets of the nearest stages before `proxy` that have any.
void collectPresets(vtkSMProxy* proxy, std::set<int>& presets)
{
  for (unsigned int i = 0; i < proxy->GetNumberOfProducers(); ++i)
  {
    vtkSMProxy* source = proxy->GetProducerProxy(i);
    if (vtkSMPresetDomain* domain = vtkSMPresetDomain::Of(source))
    {
      presets.insert(domain->Chosen());
    }
    else if (source != nullptr)
    {
      collectPresets(source, presets);
    }
  }
}

} // namespace

vtkSMPresetHelper::vtkSMPresetHelper() = default;
vtkSMPresetHelper::~vtkSMPresetHelper() = default;

void vtkSMPresetHelper::PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType initializationTimeStamp)
{
  std::set<int> presets;
  collectPresets(proxy, presets);
  vtkSMPresetDomain::Of(proxy)->Start(presets.size() == 1 ? *presets.begin() : 0, initializationTimeStamp);
  proxy->UpdateVTKObjects();
}

void vtkSMPresetHelper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
