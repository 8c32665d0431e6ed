// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkView;

namespace cactus
{

/// Turns the camera of a render view that nobody has moved yet, so that fibres along z are seen at an angle instead of end-on.
/// ParaView keeps the direction when it fits the camera to the data. Does nothing in other views.
void lookObliquely(vtkView* view);

} // namespace cactus
