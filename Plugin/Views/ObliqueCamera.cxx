// SPDX-License-Identifier: BSD-3-Clause
#include "ObliqueCamera.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPVRenderView.h>

#include <algorithm>

namespace cactus
{

namespace
{

/// Tells whether both look in the same direction from the same place.
bool agree(vtkCamera* one, vtkCamera* other)
{
  return std::equal(one->GetPosition(), one->GetPosition() + 3, other->GetPosition()) &&
         std::equal(one->GetFocalPoint(), one->GetFocalPoint() + 3, other->GetFocalPoint()) &&
         std::equal(one->GetViewUp(), one->GetViewUp() + 3, other->GetViewUp());
}

} // namespace

void lookObliquely(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  vtkCamera* camera = renderView != nullptr ? renderView->GetActiveCamera() : nullptr;
  if (camera == nullptr)
  {
    return;
  }
  const vtkNew<vtkCamera> untouched;
  const vtkNew<vtkCamera> ofNewView; // ParaView's own default for the property CameraPosition
  ofNewView->SetPosition(0.0, 0.0, 6.69);
  if (agree(camera, untouched) || agree(camera, ofNewView))
  {
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetViewUp(0.0, 1.0, 0.0); // unchanged, so that scripts that place the camera on the z axis work as before
    camera->SetPosition(obliquePosition);
  }
}

} // namespace cactus
