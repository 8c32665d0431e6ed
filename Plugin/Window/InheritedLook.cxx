// SPDX-License-Identifier: BSD-3-Clause
#include "InheritedLook.h"

#include "AfterUpdate.h"
#include "FirstLook.h"
#include "PluginProxies.h"

#include <pqDataRepresentation.h>
#include <pqObjectBuilder.h>
#include <pqOutputPort.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineFilter.h>
#include <pqPropertiesPanel.h>
#include <pqView.h>
#include <vtkColorSeries.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkNew.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVDataSetAttributesInformation.h>
#include <vtkPVGeneralSettings.h>
#include <vtkSMPVRepresentationProxy.h>
#include <vtkSMParaViewPipelineControllerWithRendering.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMViewProxy.h>

#include <QApplication>
#include <QWidget>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace cactus
{
namespace
{

constexpr int ifHidden = 2;                     ///< pqPipelineFilter::replaceInput(): if the input would hide the result
constexpr char inherited[] = "cactusInherited"; ///< dynamic property of a representation that has its look from its input
constexpr char direction[] = "Direction";       ///< point data that colour tubes
constexpr char bundle[] = "BundleId";           ///< cell data that colour them where they differ
constexpr int mostBundles = 256;                ///< with a colour of their own

/// The look of a representation that no array colours.
struct Look
{
  std::array<double, 3> colour{ { 1.0, 1.0, 1.0 } };
  bool byDirection = false;
};

/// Our types of representation (xml/views/Representations.xml), each with the property that has its colour.
constexpr std::array<std::array<const char*, 2>, 4> ourTypes{ { { { "Myelin", "MyelinColor" } }, { { "Placed", "MyelinColor" } },
  { { "Axons", "AxonColor" } }, { { "Tubes", "DiffuseColor" } } } };

const char* colourPropertyOf(vtkSMProxy* representation)
{
  const char* type = vtkSMPropertyHelper(representation, "Representation", true).GetAsString();
  const auto* found = std::find_if(
    ourTypes.begin(), ourTypes.end(), [type](const auto& one) { return type != nullptr && std::string(one[0]) == type; });
  return found != ourTypes.end() ? (*found)[1] : nullptr;
}

/// Returns the look of our representations, and of those that have it from them.
std::optional<Look> lookOf(pqDataRepresentation* shown)
{
  vtkSMProxy* proxy = shown->getProxy();
  const char* colour = colourPropertyOf(proxy);
  if (colour == nullptr && shown->property(inherited).toBool())
  {
    colour = "DiffuseColor";
  }
  if (colour == nullptr || proxy->GetProperty(colour) == nullptr)
  {
    return std::nullopt;
  }
  Look look;
  vtkSMPropertyHelper(proxy, colour).Get(look.colour.data(), 3);
  look.byDirection = vtkSMPropertyHelper(proxy, "DirectionColors", true).GetAsInt() != 0;
  return look;
}

double opacityOf(vtkSMProxy* representation)
{
  return vtkSMPropertyHelper(representation, "Opacity", true).GetAsDouble();
}

bool hasSeveralBundles(vtkPVDataInformation* data)
{
  vtkPVArrayInformation* ids = data->GetArrayInformation(bundle, vtkDataObject::CELL);
  return ids != nullptr && ids->GetComponentRange(0)[0] < ids->GetComponentRange(0)[1];
}

/// Gives the table of colours of bundles those that tubes have.
void colourBundles(vtkSMProxy* colours, vtkPVDataInformation* data)
{
  if (colours == nullptr || colours->HasAnnotation(bundle))
  {
    return;
  }
  colours->SetAnnotation(bundle, "1");
  const double* ids = data->GetArrayInformation(bundle, vtkDataObject::CELL)->GetComponentRange(0);
  vtkNew<vtkColorSeries> series;
  series->SetColorScheme(vtkColorSeries::BREWER_QUALITATIVE_SET2);
  vtkSMPropertyHelper names(colours, "Annotations");
  vtkSMPropertyHelper values(colours, "IndexedColors");
  names.SetNumberOfElements(0);
  values.SetNumberOfElements(0);
  for (int id = 1; id <= static_cast<int>(ids[1]) && id <= mostBundles; ++id)
  {
    const unsigned place = static_cast<unsigned>(id - 1);
    const vtkColor3ub colour = series->GetColorRepeating(id - 1);
    names.Set(2 * place, std::to_string(id).c_str());
    names.Set(2 * place + 1, std::to_string(id).c_str());
    for (unsigned part = 0; part < 3; ++part)
    {
      values.Set(3 * place + part, colour[int(part)] / 255.0);
    }
  }
  vtkSMPropertyHelper(colours, "IndexedLookup").Set(1);
  colours->UpdateVTKObjects();
}

void giveLook(pqDataRepresentation* shown, const Look& look, double opacity)
{
  vtkSMProxy* proxy = shown->getProxy();
  if (proxy->GetProperty("DiffuseColor") == nullptr || colourPropertyOf(proxy) != nullptr)
  {
    return; // a volume, or one of our own
  }
  for (const char* name : { "DiffuseColor", "AmbientColor" })
  {
    vtkSMPropertyHelper(proxy, name, true).Set(look.colour.data(), 3);
  }
  vtkSMPropertyHelper(proxy, "Opacity", true).Set(opacity);
  vtkPVDataInformation* data = shown->getOutputPortFromInput()->getDataInformation();
  auto* coloured = vtkSMPVRepresentationProxy::SafeDownCast(proxy);
  if (look.byDirection && coloured != nullptr && !coloured->GetUsingScalarColoring())
  {
    if (hasSeveralBundles(data))
    {
      coloured->SetScalarColoring(bundle, vtkDataObject::CELL);
      colourBundles(shown->getLookupTableProxy(), data);
    }
    else if (data->GetArrayInformation(direction, vtkDataObject::POINT) != nullptr)
    {
      coloured->SetScalarColoring(direction, vtkDataObject::POINT);
      vtkSMPropertyHelper(proxy, "MapScalars", true).Set(0); // red, green and blue as they are
    }
  }
  proxy->UpdateVTKObjects();
  shown->setProperty(inherited, true);
}

void hide(pqOutputPort* port, pqView* view)
{
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  controller->Hide(vtkSMSourceProxy::SafeDownCast(port->getSourceProxy()), port->getPortNumber(), view->getViewProxy());
}

void takePlace(pqPipelineFilter* filter, pqOutputPort* input, pqDataRepresentation* result, pqView* view)
{
  pqDataRepresentation* before = input->getRepresentation(view);
  const std::optional<Look> look = before != nullptr ? lookOf(before) : std::nullopt;
  if (!look)
  {
    return;
  }
  const double opacity = opacityOf(before->getProxy());
  giveLook(result, *look, opacity);
  if (filter->replaceInput() == ifHidden && opacity >= 1.0)
  {
    hide(input, view);
  }
  view->render();
}

/// Hides what one of our filters has taken the place of, with the inner surfaces beside outer ones. (ParaView hides inputs alone,
/// and not where one Apply has made a whole chain.)
void hideInput(pqOutputPort* input, pqView* view)
{
  hide(input, view);
  for (pqOutputPort* beside : input->getSource()->getOutputPorts())
  {
    if (input->getPortName() == "Outer" && beside->getPortName() == "Inner")
    {
      hide(beside, view);
    }
  }
}

/// Colours an image by its active array, or else the first, where one of our representations draws it.
void colourImage(pqDataRepresentation* shown, vtkPVDataInformation* data, pqView* view)
{
  auto* proxy = vtkSMPVRepresentationProxy::SafeDownCast(shown->getProxy());
  const char* type = proxy != nullptr ? vtkSMPropertyHelper(proxy, "Representation", true).GetAsString() : nullptr;
  if (type == nullptr || !(std::string(type) == "Sections" || std::string(type) == "Placed") ||
      !data->HasDataSetType(VTK_IMAGE_DATA) || proxy->GetUsingScalarColoring())
  {
    return;
  }
  for (const int of : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkPVDataSetAttributesInformation* arrays = data->GetAttributeInformation(of);
    vtkPVArrayInformation* active = arrays->GetAttributeInformation(vtkDataSetAttributes::SCALARS);
    vtkPVArrayInformation* array =
      active != nullptr || arrays->GetNumberOfArrays() == 0 ? active : arrays->GetArrayInformation(0);
    if (array != nullptr)
    {
      proxy->SetScalarColoring(array->GetName(), of);
      proxy->UpdateVTKObjects();
      proxy->RescaleTransferFunctionToDataRange(true, false);
      if (vtkPVGeneralSettings::GetInstance()->GetScalarBarMode() ==
          vtkPVGeneralSettings::AUTOMATICALLY_SHOW_AND_HIDE_SCALAR_BARS)
      {
        proxy->SetScalarBarVisibility(view->getProxy(), true);
      }
      view->render();
      return;
    }
  }
}

bool hasShownNothing(pqPipelineSource* source)
{
  bool isEmpty = true;
  forEachShown(source, [&](pqDataRepresentation*, pqOutputPort* port, pqView*)
    { isEmpty = isEmpty && port->getDataInformation()->GetNumberOfPoints() == 0; });
  return isEmpty;
}

} // namespace

InheritedLook::InheritedLook(pqPVApplicationCore* core)
  : QObject(core)
{
  QObject::connect(core->getObjectBuilder(), &pqObjectBuilder::filterCreated, this,
    [this](pqPipelineSource* created) { this->Created.append(created); });
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    for (pqPropertiesPanel* panel : window->findChildren<pqPropertiesPanel*>())
    {
      QObject::connect(panel, QOverload<>::of(&pqPropertiesPanel::applied), this, &InheritedLook::afterApply);
    }
  }
}

void InheritedLook::afterApply()
{
  QList<QPointer<pqPipelineSource>> waiting;
  waiting.swap(this->Created);
  int chain = 0;
  pqPipelineSource* last = nullptr;
  for (const QPointer<pqPipelineSource>& created : waiting)
  {
    pqPipelineFilter* filter = qobject_cast<pqPipelineFilter*>(created);
    if (filter != nullptr && filter->modifiedState() == pqProxy::UNINITIALIZED)
    {
      this->Created.append(created); // Apply was for the panel of another
    }
    else if (filter != nullptr && isOfThisPlugin(filter->getProxy()) && hasShownNothing(filter))
    {
      this->Created.append(created); // an error, or tables
    }
    else if (filter != nullptr && filter->replaceInput() != 0)
    {
      forEachShown(filter,
        [filter](pqDataRepresentation* shown, pqOutputPort* port, pqView* view)
        {
          for (pqOutputPort* input : filter->getAllInputs())
          {
            if (isOfThisPlugin(filter->getProxy()))
            {
              hideInput(input, view);
            }
            else
            {
              takePlace(filter, input, shown, view);
            }
          }
          colourImage(shown, port->getDataInformation(), view);
        });
      chain += isOfThisPlugin(filter->getProxy()) ? 1 : 0;
      last = filter;
    }
  }
  if (chain > 1)
  {
    FirstLook::fitAgain(last); // without what was shown of those before it
  }
}

} // namespace cactus
