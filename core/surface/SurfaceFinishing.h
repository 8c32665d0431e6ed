// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfaceDecimation.h"
#include "mesh/TriangleTree.h"
#include "surface/FibreSurfacePair.h"
#include "surface/SmoothedField.h"
#include "surface/SurfaceFilters.h"

#include <vector>

namespace cactus
{

/// Where a coarsened surface must not stay as it is, since it cuts or touches itself, or would in a file, in single precision.
std::vector<Eigen::Vector3d> placesThatMeet(const TriangleMesh& mesh);

/// Bounds for coarsening a surface once more of which something was wrong at some places, for the first time (attempt 0) or
/// again.
std::vector<LocalErrorBound> boundsAround(const std::vector<Eigen::Vector3d>& places, double spacing, int attempt);

/// What a contour is to become.
struct SurfaceTarget
{
  double contoured = 0.0;                  ///< level of the field that the contour lies at, µm
  double level = 0.0;                      ///< and that it is to lie at, a little beside that
  double volume = 0.0;                     ///< µm³
  const TriangleTree* container = nullptr; ///< a surface that it must not meet
  std::vector<LocalErrorBound> bounds;     ///< where it is coarsened less
};

/// Makes surfaces to be kept out of contours of fields, with points in single precision, as files hold them. May be used from
/// several threads.
class SurfaceFinishing
{
public:
  /// `decimationError` and `minimumAngle` as in MyelinSurfaceOptions; `spacing` is that of the voxels. With `filters` these
  /// coarsen. What is given by reference has to outlive the object.
  SurfaceFinishing(double decimationError, double minimumAngle, double spacing, const SurfaceFilters* filters);

  /// Coarsens a contour, gives it its volume, and checks what comes out. If something is wrong with it, it is made again with
  /// less coarsening around there; what cannot be repaired like that stays as contoured, without pieces that enclose no volume,
  /// which may leave an empty mesh. Measures it in `report`, and says in `change` what has become of it, and adds to what was
  /// dropped. Returns whether the surface is as it has to be.
  bool finish(const SmoothedField& field, const SurfaceTarget& target, CappedSurface& surface, SurfaceReport& report,
    SurfaceChange& change) const;

  /// Splits needles that moving has left in a coarsened surface, evens its fans again and rounds its points.
  void finishMoved(CappedSurface& surface) const;

private:
  bool coarsen(const SmoothedField& field, const SurfaceTarget& target, CappedSurface& surface, SurfaceReport& report,
    SurfaceChange& change) const;
  double largestMove(const SmoothedField& field, const CappedSurface& surface, double level) const;

  void even(CappedSurface& surface) const;
  void even(CappedSurface& surface, SurfaceReport& report) const;
  void reshape(CappedSurface& surface, const SurfaceDecimationOptions& decimation) const;

  double DecimationError;
  double MinimumAngle; ///< degrees
  double Spacing;
  const SurfaceFilters* Filters; ///< null for decimate()
};

} // namespace cactus
