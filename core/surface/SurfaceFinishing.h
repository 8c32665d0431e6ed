// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "mesh/SurfaceDecimation.h"
#include "mesh/TriangleTree.h"
#include "surface/FibreSurfacePair.h"
#include "surface/SmoothedField.h"
#include "surface/SurfaceFilters.h"

#include <vector>

namespace cactus
{

/// Returns where a coarsened surface has to be changed, since it cuts or touches itself, or would in a file, in single precision.
std::vector<Eigen::Vector3d> placesThatMeet(const TriangleMesh& mesh);

/// Returns bounds for coarsening a surface again after faults at some places, for the first time (attempt 0) or later.
std::vector<LocalErrorBound> boundsAround(const std::vector<Eigen::Vector3d>& places, double spacing, int attempt);

/// The targets of a finished contour.
struct SurfaceTarget
{
  double contoured = 0.0;                  ///< level of the field at which the contour lies, µm
  double level = 0.0;                      ///< level at which it should lie, slightly different, µm
  double volume = 0.0;                     ///< µm³
  const TriangleTree* container = nullptr; ///< a surface that it must not meet
  std::vector<LocalErrorBound> bounds;     ///< where it is coarsened less
  bool hasEvenFans = true; ///< off for a surface that is to be moved: small triangles fold where large ones do not
};

/// Turns contours of fields into final surfaces, with points in single precision, as in files. Thread-safe.
class SurfaceFinishing
{
public:
  /// `decimationError` and `minimumAngle` as in MyelinSurfaceOptions; `spacing` is that of the voxels in `box`, `rimDepth` (µm)
  /// the depth down to which sharp rims are blunted, see evenFans. With `filters` these coarsen. All arguments passed by
  /// reference have to outlive the object.
  SurfaceFinishing(double decimationError, double minimumAngle, double spacing, double rimDepth, const Domain& box,
    const SurfaceFilters* filters);

  /// Coarsens a contour, moves it to its volume, and checks the result. A faulty surface is made again with less coarsening
  /// around its faults; if that does not help it stays as contoured, without pieces that enclose no volume, which may leave an
  /// empty mesh. Measures it in `report`, records its changes in `change`, and adds to the dropped volume. Returns whether the
  /// surface is free of faults.
  bool finish(const SmoothedField& field, const SurfaceTarget& target, CappedSurface& surface, SurfaceReport& report,
    SurfaceChange& change) const;

  /// Splits needles that moving has left in a coarsened surface, and rounds its points.
  void finishMoved(CappedSurface& surface) const;

  /// Makes the fans of a surface even (see evenFans), and rounds its points. Precondition: closed manifold.
  void even(CappedSurface& surface) const;

private:
  bool coarsen(const SmoothedField& field, const SurfaceTarget& target, CappedSurface& surface, SurfaceReport& report,
    SurfaceChange& change) const;
  double largestMove(const SmoothedField& field, const CappedSurface& surface, double level) const;

  /// Does so if the surface is a closed manifold, and measures it again.
  void even(CappedSurface& surface, SurfaceReport& report) const;
  std::vector<Eigen::Vector3d> faultsOf(const CappedSurface& surface, const SurfaceTarget& target, SurfaceChange& change) const;
  void reshape(CappedSurface& surface, const SurfaceDecimationOptions& decimation) const;

  double DecimationError;
  double MinimumAngle; ///< degrees
  double Spacing;
  double RimDepth;
  const Domain& Box;
  const SurfaceFilters* Filters; ///< null for decimate()
};

} // namespace cactus
