// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkSmartPointer.h>

class vtkFieldData;
class vtkMatrix4x4;
class vtkPolyData;

namespace cactus
{

/// Returns the affine in field data `Placement`, row by row, by which the data left the domain's space; else the identity.
vtkSmartPointer<vtkMatrix4x4> placementIn(vtkFieldData* facts);

/// Returns `shape` with the twelve edges of the box in field data `Domain` (xmin xmax ymin ymax zmin zmax), in its placed
/// position. The edges are lines with the attributes of the first point and cell, except that colours are grey. Without a Domain,
/// or for an empty shape: `shape` alone.
vtkSmartPointer<vtkPolyData> withDomainBox(vtkPolyData* shape, vtkFieldData* facts);

} // namespace cactus
