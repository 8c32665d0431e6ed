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

/// Whether both look the same way from the same place.
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
    camera->SetViewUp(0.0, 1.0, 0.0); // as before, so that scripts which place the camera on the z axis find what they expect
    camera->SetPosition(obliquePosition);
  }
}

} // namespace cactus
