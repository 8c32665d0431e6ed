// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleTree.h"
#include "surface/FibreField.h"
#include "surface/SampledVolume.h"
#include "surface/SmoothedField.h"
#include "surface/SurfaceFilters.h"

namespace cactus
{

/// Contours the fields of fibres in the box of a label image, and keeps the main part of each contour (see keepMainPart()),
/// without pieces below a voxel. Thread-safe.
class FibreContours
{
public:
  /// Inner contours end `inset` (µm) inside the faces of the box, since their caps would otherwise meet the outer ones. Contours
  /// keep `nudge` (µm) away from the samples. With `filters` these contour the field. All arguments passed by reference have to
  /// outlive the object.
  FibreContours(const FibreField& field, double inset, double nudge, const SurfaceFilters* filters);

  /// Returns the contour at `level`; sets `dropped` to the volume (µm³) of the pieces that were left out.
  CappedSurface outerAt(const SmoothedField& field, double level, double& dropped) const;
  /// Does the same for an inner surface. If `within` is given, pieces that do not begin inside it are left out first, and their
  /// volume does not count.
  CappedSurface innerAt(const SmoothedField& field, double level, const TriangleTree* within, double& dropped) const;
  /// Returns the outer surface at level 0 of the unsmoothed field, always by contour().
  CappedSurface unsmoothed(const SmoothedField& field) const;
  /// Returns the volumes of inner surfaces at levels from `lowest` (µm) on.
  SampledVolume innerVolumes(const SmoothedField& field, double lowest) const;

private:
  CappedSurface contourAt(double inset, const SmoothedField& field, double level) const;

  const FibreField& Field;
  const SurfaceFilters* Filters; ///< null for contour()
  double Inset;
  double Nudge;
  double SmallestPiece; ///< µm³
  NodeLattice OuterLattice;
  NodeLattice InnerLattice;
};

} // namespace cactus
