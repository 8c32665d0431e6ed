// SPDX-License-Identifier: BSD-3-Clause
#include "IdleGrowth.h"

#include "PluginProxies.h"

#include <pqPropertyWidget.h>
#include <pqPropertyWidgetDecorator.h>
#include <vtkDataObject.h>
#include <vtkPVDataInformation.h>
#include <vtkSMInputProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMUncheckedPropertyHelper.h>

#include <cstring>

namespace cactus
{
namespace
{

/// Tells whether a filter's target is the fraction that its fibres were made for, and these know it.
bool growsAsMade(vtkSMProxy* proxy)
{
  if (vtkSMUncheckedPropertyHelper(proxy, "TargetFibreVolumeFraction").GetAsDouble() != -1.0)
  {
    return false;
  }
  const vtkSMPropertyHelper input(proxy, "Input");
  auto* fibres = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  return fibres != nullptr && fibres->GetDataInformation(input.GetOutputPort())
                                  ->GetArrayInformation("GrownFibreVolumeFraction", vtkDataObject::FIELD) != nullptr;
}

class Idle : public pqPropertyWidgetDecorator
{
public:
  explicit Idle(pqPropertyWidget* widget)
    : pqPropertyWidgetDecorator(nullptr, widget)
  {
  }

  bool canShowWidget(bool /*isAdvanced*/) const override { return !growsAsMade(this->parentWidget()->proxy()); }
};

} // namespace

IdleGrowth::IdleGrowth(QObject* parent)
  : QObject(parent)
{
}

void IdleGrowth::createDefaultWidgetDecorators(pqPropertyWidget* widget)
{
  if (isOfThisPlugin(widget->proxy()) && widget->property() != nullptr &&
      std::strcmp(widget->property()->GetXMLName(), "GrowthIterations") == 0)
  {
    new Idle(widget);
  }
}

} // namespace cactus
