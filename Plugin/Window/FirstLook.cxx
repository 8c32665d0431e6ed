// SPDX-License-Identifier: BSD-3-Clause
#include "FirstLook.h"

#include "AfterUpdate.h"
#include "ObliqueCamera.h"

#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <vtkBoundingBox.h>
#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkPVDataInformation.h>
#include <vtkSMRenderViewProxy.h>

#include <QVariant>

#include <algorithm>
#include <cmath>

namespace cactus
{
namespace
{

constexpr double sameDirection = 1e-4; ///< radians

/// Returns the angle (radians) between a camera's position and that of lookObliquely().
double acrossFromPut(vtkCamera* camera)
{
  double from[3];
  vtkMath::Subtract(camera->GetPosition(), camera->GetFocalPoint(), from);
  return std::acos(std::min(1.0, vtkMath::Dot(from, obliquePosition) / (vtkMath::Norm(from) * vtkMath::Norm(obliquePosition))));
}

/// Tells whether a camera has the position of lookObliquely(), as set or fitted to an empty view.
bool wasFittedToNothing(vtkCamera* camera)
{
  const double origin[] = { 0.0, 0.0, 0.0 };
  const double* position = camera->GetPosition();
  if (!std::equal(origin, origin + 3, camera->GetFocalPoint()))
  {
    return false;
  }
  const double distance = vtkMath::Norm(position);
  const double put = vtkMath::Norm(obliquePosition);
  const double fitted =
    std::sqrt(3.0) / std::sin(vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle())); // to a cube from -1 to 1
  return acrossFromPut(camera) < sameDirection && std::min(std::abs(distance - put), std::abs(distance - fitted)) < 1e-3;
}

// Dynamic properties of a view: the camera when it was last fitted, and the size of the data then.
constexpr char lastCamera[] = "cactusLastCamera";
constexpr char lastSize[] = "cactusLastSize";

/// Sizes closer than this fraction count as equal: fibres that the optimiser has bent reach a little further.
constexpr double sameSize = 0.1;

QVariant placeOf(vtkCamera* camera)
{
  QVariantList place;
  for (int axis = 0; axis < 3; ++axis)
  {
    place << camera->GetPosition()[axis] << camera->GetFocalPoint()[axis] << camera->GetViewUp()[axis];
  }
  return place << camera->GetParallelScale();
}

/// Returns the diagonal of what a source shows in a view; 0 for nothing.
double sizeIn(pqRenderView* view, pqPipelineSource* source)
{
  vtkBoundingBox box;
  forEachShown(source,
    [&](pqDataRepresentation* shown, pqOutputPort* port, pqView* where)
    {
      if (where == view && shown->isVisible())
      {
        box.AddBounds(port->getDataInformation()->GetBounds());
      }
    });
  return box.IsValid() ? box.GetDiagonalLength() : 0.0;
}

void fitIn(pqRenderView* view, pqPipelineSource* source, bool isAgain)
{
  const double size = sizeIn(view, source);
  const double before = view->property(lastSize).toDouble();
  const bool isOther = size > 0.0 && before > 0.0 && std::fabs(size - before) > sameSize * before;
  vtkCamera* camera = view->getRenderViewProxy()->GetActiveCamera();
  const QVariant last = view->property(lastCamera);
  if (wasFittedToNothing(camera) || ((isOther || isAgain) && last == placeOf(camera)))
  {
    view->resetCamera();
  }
  else if (last.isValid() || acrossFromPut(camera) > sameDirection)
  {
    return; // the user has moved it, or nothing has changed
  }
  view->setProperty(lastCamera, placeOf(camera));
  if (size > 0.0)
  {
    view->setProperty(lastSize, size);
  }
}

void fit(pqPipelineSource* source, bool isAgain)
{
  for (pqView* view : source->getViews())
  {
    if (pqRenderView* renderView = qobject_cast<pqRenderView*>(view))
    {
      fitIn(renderView, source, isAgain);
    }
  }
}

} // namespace

FirstLook::FirstLook(pqPVApplicationCore* core)
  : QObject(core)
{
  afterUpdate(core, this, [](pqPipelineSource* source) { fit(source, false); });
}

void FirstLook::fitAgain(pqPipelineSource* source)
{
  fit(source, true);
}

} // namespace cactus
