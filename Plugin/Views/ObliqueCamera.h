// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkView;

namespace cactus
{

/// The camera position of lookObliquely(), looking at the origin: a cube shows three of its faces, the one across the fibres
/// widest.
constexpr double obliquePosition[3] = { 1.5, 1.1, 2.0 };

/// Turns the camera of a render view, if nobody has moved it yet, so that fibres along z are seen at an angle instead of end-on.
/// ParaView keeps the direction when it fits the camera to the data. Does nothing in other views.
void lookObliquely(vtkView* view);

} // namespace cactus
