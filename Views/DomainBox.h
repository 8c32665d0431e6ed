// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkSmartPointer.h>

class vtkFieldData;
class vtkPolyData;

namespace cactus
{

/// `shape` with the twelve edges of the box that the field data `Domain` (xmin xmax ymin ymax zmin zmax) describe, as lines with
/// the attributes of the first point and cell, but grey where these are colours. Without a Domain, or an empty shape: `shape`
/// alone.
vtkSmartPointer<vtkPolyData> withDomainBox(vtkPolyData* shape, vtkFieldData* facts);

} // namespace cactus
