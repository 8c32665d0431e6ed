// SPDX-License-Identifier: BSD-3-Clause
// Surfaces by VTK's own filters: flying edges, windowed sinc smoothing and quadric decimation.
#pragma once

#include "mesh/CappedSurface.h"
#include "stages/VtkMeshingOptions.h"
#include "surface/FibreImage.h"
#include "surface/SurfaceFilters.h"

namespace cactus
{

/// Returns the closed surface on which an image's field is `level` (µm), oriented outwards, by vtkFlyingEdges3D. Points within a
/// thousandth of a voxel of a face of `box` (µm), where its caps are, are moved into that face and marked so. Thread-safe.
CappedSurface contourByVtk(const FibreImage& image, double level, const Eigen::AlignedBox3d& box);

/// Smooths a surface by vtkWindowedSincPolyDataFilter and coarsens it by vtkQuadricDecimation. Caps stay in their faces, other
/// points inside the box. Nothing else is guaranteed: surfaces may come to meet themselves or each other. Thread-safe.
void finishByVtk(CappedSurface& surface, const VtkMeshingOptions& options, double spacing);

/// Returns both functions, for myelinSurfaces() on a label image with voxels of `spacing` µm. Throws as validate().
SurfaceFilters surfaceFiltersOfVtk(const VtkMeshingOptions& options, double spacing);

} // namespace cactus
