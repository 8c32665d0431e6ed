// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorColours.h"

#include "AfterUpdate.h"

#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqView.h>
#include <vtkDataObject.h>
#include <vtkNew.h>
#include <vtkPVDataInformation.h>
#include <vtkPVGeneralSettings.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRepresentationProxy.h>
#include <vtkSMTransferFunctionManager.h>

#include <QVariant>

#include <string>

namespace cactus
{
namespace
{

constexpr char errorName[] = "Error";             ///< field data array with the error message (Filters/FilterSupport.cxx)
constexpr char wantedLook[] = "cactusWantedLook"; ///< dynamic property of a representation that was coloured by it: for example
                                                  ///< Slice
constexpr char plainLook[] = "Outline";           ///< needs no colours

/// Returns the array that colours a representation; empty if there is none.
std::string colouredBy(vtkSMProxy* representation, int& association)
{
  const vtkSMPropertyHelper array(representation, "ColorArrayName", true);
  association = array.GetInputArrayAssociation();
  const char* name = array.GetInputArrayNameToProcess();
  return name != nullptr ? name : "";
}

void mendColours(pqDataRepresentation* shown, pqView* view, bool isEmpty)
{
  vtkSMProxy* proxy = shown->getProxy();
  if (proxy->GetProperty("ColorArrayName") == nullptr || proxy->GetProperty("Representation") == nullptr)
  {
    return;
  }
  int association = 0;
  const std::string name = colouredBy(proxy, association);
  if (association == vtkDataObject::FIELD && name == errorName)
  {
    shown->setProperty(wantedLook, vtkSMPropertyHelper(proxy, "Representation").GetAsString());
    vtkSMPropertyHelper(proxy, "ColorArrayName").SetInputArrayToProcess(vtkDataObject::POINT, "");
    vtkSMRepresentationProxy::SetRepresentationType(proxy, plainLook);
    proxy->UpdateVTKObjects();
    vtkNew<vtkSMTransferFunctionManager> colours;
    colours->UpdateScalarBars(view->getProxy(), vtkSMTransferFunctionManager::HIDE_UNUSED_SCALAR_BARS);
  }
  const std::string look = shown->property(wantedLook).toString().toStdString();
  if (isEmpty || look.empty())
  {
    return;
  }
  shown->setProperty(wantedLook, QVariant());
  if (colouredBy(proxy, association).empty() &&
      vtkSMPropertyHelper(proxy, "Representation").GetAsString() == std::string(plainLook))
  {
    vtkSMRepresentationProxy::SetRepresentationType(proxy, look.c_str()); // also chooses an array
    if (vtkPVGeneralSettings::GetInstance()->GetScalarBarMode() == vtkPVGeneralSettings::AUTOMATICALLY_SHOW_AND_HIDE_SCALAR_BARS)
    {
      vtkNew<vtkSMTransferFunctionManager> colours;
      colours->UpdateScalarBars(view->getProxy(), vtkSMTransferFunctionManager::SHOW_USED_SCALAR_BARS);
    }
    view->render();
  }
}

} // namespace

ErrorColours::ErrorColours(pqPVApplicationCore* core)
  : QObject(core)
{
  afterUpdate(core, this, [this](pqPipelineSource* source) { this->mend(source); });
}

void ErrorColours::mend(pqPipelineSource* source)
{
  forEachShown(source, [](pqDataRepresentation* shown, pqOutputPort* port, pqView* view)
    { mendColours(shown, view, port->getDataInformation()->GetNumberOfPoints() == 0); });
}

} // namespace cactus
