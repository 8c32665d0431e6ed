// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace cactus
{

/// Returns `surface` with its outermost points along each axis, if these are caps close to a face of the box in field data
/// `Domain`, moved outside of that face by a thousandth of the box: this makes axons visible, which end slightly inside of the
/// outer surfaces' caps. Without a Domain: `surface` itself.
vtkSmartPointer<vtkPolyData> withLiftedCaps(vtkPolyData* surface);

} // namespace cactus
