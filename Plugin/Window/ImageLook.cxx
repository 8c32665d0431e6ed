// SPDX-License-Identifier: BSD-3-Clause
#include "ImageLook.h"

#include "AfterUpdate.h"

#include <pqDataRepresentation.h>
#include <pqObjectBuilder.h>
#include <pqOutputPort.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqView.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QVariant>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace cactus
{
namespace
{

constexpr char isNew[] = "cactusNew";        ///< dynamic property of a filter that the window has made, and not shown yet
constexpr char isOurs[] = "cactusImageLook"; ///< annotation of a table of colours that has had this look

// Blue and red as in ParaView's "Cool to Warm".
constexpr double cold[] = { 0.231, 0.298, 0.753 };
constexpr double white[] = { 1.0, 1.0, 1.0 };
constexpr double warm[] = { 0.706, 0.016, 0.149 };

void showGreys(vtkSMProxy* colours)
{
  const double greys[] = { 0.0, 0.0, 0.0, 0.0, 255.0, 1.0, 1.0, 1.0 };
  vtkSMPropertyHelper(colours, "RGBPoints").Set(greys, 8);
  vtkSMPropertyHelper(colours, "ColorSpace").Set("RGB");
  colours->UpdateVTKObjects();
}

/// Tells whether points of a table of colours are cold, white and warm.
bool areOurs(const std::vector<double>& points)
{
  return points.size() == 12 && std::equal(cold, cold + 3, &points[1]) && std::equal(white, white + 3, &points[5]) &&
         std::equal(warm, warm + 3, &points[9]);
}

/// Makes 0 white, in colours of ours; `isFirst`: in place of any others.
void whitenZero(vtkSMProxy* colours, bool isFirst)
{
  vtkSMPropertyHelper points(colours, "RGBPoints");
  const std::vector<double> now = points.GetDoubleArray();
  if (!(isFirst || areOurs(now)) || now.size() < 8 || !(now.front() < 0.0) || !(now[now.size() - 4] > 0.0))
  {
    return;
  }
  const double next[] = { now.front(), cold[0], cold[1], cold[2], 0.0, white[0], white[1], white[2], now[now.size() - 4], warm[0],
    warm[1], warm[2] };
  points.Set(next, 12);
  vtkSMPropertyHelper(colours, "ColorSpace").Set("Diverging");
  colours->UpdateVTKObjects();
}

void showBox(vtkSMProxy* representation)
{
  vtkSMProxy* axes = vtkSMPropertyHelper(representation, "DataAxesGrid", true).GetAsProxy();
  if (axes == nullptr)
  {
    return;
  }
  for (const char* axis : { "x", "y", "z" })
  {
    const std::string title = std::string(1, static_cast<char>(axis[0] - 'x' + 'X')) + "Title";
    vtkSMPropertyHelper(axes, title.c_str()).Set((std::string(axis) + " (µm)").c_str());
  }
  vtkSMPropertyHelper(axes, "GridAxesVisibility").Set(1);
  axes->UpdateVTKObjects();
}

} // namespace

ImageLook::ImageLook(pqPVApplicationCore* core)
  : QObject(core)
{
  QObject::connect(core->getObjectBuilder(), &pqObjectBuilder::filterCreated, this,
    [](pqPipelineSource* created) { created->setProperty(isNew, true); });
  afterUpdate(core, this, &ImageLook::apply);
}

void ImageLook::apply(pqPipelineSource* source)
{
  const std::string name = source->getProxy()->GetXMLName();
  const bool isGrowth = name == "FibreRadialGrowth";
  if (!isGrowth && name != "HistologyMask")
  {
    return;
  }
  forEachShown(source,
    [source, isGrowth](pqDataRepresentation* shown, pqOutputPort*, pqView* view)
    {
      const char* array = vtkSMPropertyHelper(shown->getProxy(), "ColorArrayName", true).GetInputArrayNameToProcess();
      vtkSMProxy* colours = shown->getLookupTableProxy();
      if (colours == nullptr || array == nullptr || std::strcmp(array, isGrowth ? "Depth" : "Mask") != 0)
      {
        return;
      }
      const bool isFirst = source->property(isNew).toBool();
      const bool isTableNew = isFirst && !colours->HasAnnotation(isOurs);
      source->setProperty(isNew, false);
      if (isTableNew)
      {
        colours->SetAnnotation(isOurs, "1");
      }
      if (isGrowth)
      {
        whitenZero(colours, isTableNew);
      }
      else if (isTableNew)
      {
        showGreys(colours);
      }
      if (isGrowth && isFirst)
      {
        showBox(shown->getProxy());
      }
      view->render();
    });
}

} // namespace cactus
