// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleTree.h"
#include "surface/FibreField.h"
#include "surface/SampledVolume.h"
#include "surface/SmoothedField.h"
#include "surface/SurfaceFilters.h"

namespace cactus
{

/// Contours the field of one fibre after the other in the box of a label image, and keeps the main part of what comes out (see
/// keepMainPart()), without pieces below a voxel. May be used from several threads.
class FibreContours
{
public:
  /// Inner contours end `inset` (µm) inside the faces of the box: in one plane, their caps would meet the outer ones. Contours
  /// keep `nudge` (µm) away from the samples. With `filters` these contour the field. What is given by reference has to outlive
  /// the object.
  FibreContours(const FibreField& field, double inset, double nudge, const SurfaceFilters* filters);

  /// Where the field is `level`; `dropped` becomes the volume (µm³) of the pieces that were left out.
  CappedSurface outerAt(const SmoothedField& field, double level, double& dropped) const;
  /// The same for an inner surface, of which all pieces that do not begin inside `within`, where given, are left out first. Their
  /// volume does not count.
  CappedSurface innerAt(const SmoothedField& field, double level, const TriangleTree* within, double& dropped) const;
  /// The outer surface at level 0 of the field before it was smoothed, always by contour().
  CappedSurface unsmoothed(const SmoothedField& field) const;
  /// What inner surfaces at levels from `lowest` (µm) on hold.
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
