// SPDX-License-Identifier: BSD-3-Clause
#include "BarUnits.h"

#include "AfterUpdate.h"

#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqView.h>
#include <vtkNew.h>
#include <vtkPVXMLElement.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMTransferFunctionManager.h>

#include <QString>
#include <QTimer>

#include <string>

namespace cactus
{
namespace
{

/// Returns the unit of an array of a source or filter, by the hints in its XML; empty without one.
std::string unitOf(const std::string& array, vtkSMProxy* source)
{
  vtkPVXMLElement* hints = source->GetHints();
  for (unsigned int i = 0; i < hints->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* output = hints->GetNestedElement(i);
    for (unsigned int j = 0; j < output->GetNumberOfNestedElements(); ++j)
    {
      vtkPVXMLElement* told = output->GetNestedElement(j);
      if (std::string(told->GetName()) == "Array" && told->GetAttributeOrEmpty("name") == array)
      {
        return told->GetAttributeOrEmpty("unit");
      }
    }
  }
  return {};
}

/// Returns a title as it comes out of a Python state: ParaView saves its UTF-8 as if it were Latin-1, so that µ is "Âµ".
std::string misread(const std::string& title)
{
  return QString::fromLatin1(title.c_str()).toStdString();
}

} // namespace

BarUnits::BarUnits(pqPVApplicationCore* core)
  : QObject(core)
{
  afterUpdate(core, this, [this](pqPipelineSource* source) { this->watch(source); });
}

void BarUnits::watch(pqPipelineSource* source)
{
  forEachShown(source,
    [this](pqDataRepresentation* shown, pqOutputPort*, pqView*)
    {
      QObject::connect(
        shown, &pqDataRepresentation::colorTransferFunctionModified, this, &BarUnits::afterColouring, Qt::UniqueConnection);
      addUnit(shown);
    });
}

void BarUnits::afterColouring()
{
  if (pqDataRepresentation* shown = qobject_cast<pqDataRepresentation*>(this->sender()))
  {
    QTimer::singleShot(0, shown, [shown] { addUnit(shown); }); // ParaView sets the title only after this
  }
}

void BarUnits::addUnit(pqDataRepresentation* shown)
{
  vtkSMProxy* colours = shown->getLookupTableProxy();
  if (colours == nullptr || shown->getView() == nullptr)
  {
    return;
  }
  const vtkSMPropertyHelper array(shown->getProxy(), "ColorArrayName", true);
  const char* name = array.GetInputArrayNameToProcess();
  const std::string unit = name != nullptr ? unitOf(name, shown->getInput()->getProxy()) : "";
  if (unit.empty())
  {
    return;
  }
  vtkNew<vtkSMTransferFunctionManager> manager;
  vtkSMProxy* bar = manager->GetScalarBarRepresentation(colours, shown->getView()->getProxy());
  vtkSMPropertyHelper title(bar, "Title");
  const std::string wanted = std::string(name) + " (" + unit + ")";
  const std::string now = title.GetAsString();
  if (now == name || now == misread(wanted))
  {
    title.Set(wanted.c_str());
    bar->UpdateVTKObjects();
    shown->getView()->render();
  }
}

} // namespace cactus
