// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace cactus
{

/// `surface` with its outermost points along each axis, where these are caps close to a face of the box in field data `Domain`,
/// moved to a thousandth of the box outside of that face: axons, which end a little inside of the outer surfaces' caps, are then
/// seen there. Without a Domain: `surface` itself.
vtkSmartPointer<vtkPolyData> withLiftedCaps(vtkPolyData* surface);

} // namespace cactus
