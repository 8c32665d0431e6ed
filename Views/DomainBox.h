// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkSmartPointer.h>

class vtkFieldData;
class vtkMatrix4x4;
class vtkPolyData;

namespace cactus
{

/// The affine that field data `Placement` hold, row by row, by which data came out of the domain's space; else the identity.
vtkSmartPointer<vtkMatrix4x4> placementIn(vtkFieldData* facts);

/// `shape` with the twelve edges of the box that the field data `Domain` (xmin xmax ymin ymax zmin zmax) describe, where it is
/// placed, as lines with the attributes of the first point and cell, but grey where these are colours. Without a Domain, or an
/// empty shape: `shape` alone.
vtkSmartPointer<vtkPolyData> withDomainBox(vtkPolyData* shape, vtkFieldData* facts);

} // namespace cactus
