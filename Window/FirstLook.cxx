// SPDX-License-Identifier: BSD-3-Clause
#include "FirstLook.h"

#include "ObliqueCamera.h"
#include "PluginProxies.h"

#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqServerManagerModel.h>
#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkSMRenderViewProxy.h>

#include <QPointer>
#include <QTimer>

#include <algorithm>
#include <cmath>

namespace cactus
{
namespace
{

/// Whether a camera looks from where lookObliquely() has put it, as it was put or fitted to a view with nothing in it.
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
  const double across = std::acos(std::min(1.0, vtkMath::Dot(position, obliquePosition) / (distance * put)));
  return across < 1e-4 && std::min(std::abs(distance - put), std::abs(distance - fitted)) < 1e-3;
}

} // namespace

FirstLook::FirstLook(pqPVApplicationCore* core)
  : QObject(core)
{
  connect(core->getServerManagerModel(), &pqServerManagerModel::dataUpdated, this,
    [this](pqPipelineSource* source)
    {
      // The views have the data only after this.
      QTimer::singleShot(0, this, [this, source = QPointer<pqPipelineSource>(source)] { this->fit(source); });
    });
}

void FirstLook::fit(pqPipelineSource* source)
{
  if (source == nullptr || !isOfThisPlugin(source->getProxy()))
  {
    return;
  }
  for (pqView* view : source->getViews())
  {
    pqRenderView* renderView = qobject_cast<pqRenderView*>(view);
    if (renderView != nullptr && wasFittedToNothing(renderView->getRenderViewProxy()->GetActiveCamera()))
    {
      renderView->resetCamera();
    }
  }
}

} // namespace cactus
