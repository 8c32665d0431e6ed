// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/ColumnTable.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/TriangleMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace cactus
{

/// The result for a fibre's myelin.
enum class MyelinState
{
  AsAsked = 0,
  Thinner = 1, ///< thinner: otherwise the axon would break within the box
  Thicker = 2, ///< thicker: myelin is at least MinimumGap (and leastSeparation) thick, and the axon does not leave it
  NoAxon = 3,  ///< the fibre is too thin to hold an unbroken axon inside myelin of that thickness: no inner surface
  NoFibre = 4  ///< the fibre has no voxel of the image, or too few for a closed surface: no surface
};

/// Changes of a surface after it was contoured.
struct SurfaceChange
{
  double largestMove = 0.0;   ///< µm, largest |field - level| found on the final surface away from caps
  double droppedVolume = 0.0; ///< µm³, of removed pieces apart from the main one, and of closed-in cavities
  /// For an inner surface: its place is limited by the outer one.
  bool isHemmedIn = false;
};

inline auto membersOf(SurfaceChange& change)
{
  return std::tie(change.largestMove, change.droppedVolume, change.isHemmedIn);
}

/// The surfaces of one fibre and what was measured on them.
struct FibreSurfacePair
{
  int fibreId = 0;
  int bundleId = 0;
  double targetRadius = 0.0;
  TriangleMesh outer; ///< empty for NoFibre
  TriangleMesh inner; ///< empty for NoFibre and NoAxon
  SurfaceReport outerReport;
  SurfaceReport innerReport;
  SurfaceChange outerChange;
  SurfaceChange innerChange;
  MyelinState state = MyelinState::NoFibre;
  /// Volume (µm³) of the outer surface before it was kept apart from others; NaN if there was none.
  double volumeAsMade = std::numeric_limits<double>::quiet_NaN();
  double outerLevel = 0.0; ///< µm, the field's value on the outer surface, 0 or slightly below
  double thickness = 0.0;  ///< µm, depth of the inner surface below the outer one: the difference of the field
  double ownGRatio = std::numeric_limits<double>::quiet_NaN(); ///< the TargetGRatio of the fibre itself; NaN if it has none
  double targetGRatio = 0.0;
  int nodes = 0;                ///< number of nodes of Ranvier in the box
  double internodeLength = 0.0; ///< µm; 0 if the fibre has no node
  double wholeMyelin = 0.0;     ///< µm³, volume that all of the myelin would have; 0 if none is lacking
  double gRatio = 0.0;          ///< the one reached: sqrt(inner volume / outer volume); 0 without an axon
  bool isWanted = true;         ///< false only if the centre line is known to pass outside the domain
  /// Whether a surface has a fault that could not be repaired: it meets itself or the other one, or is nearer than MinimumGap
  /// (and leastSeparation) to another fibre.
  bool isFlawed = false;
  /// Whether the inner surface was made with the outer one, which has not been moved since.
  bool isInnerMade = false;
  bool isMoved = false; ///< whether the outer surface was moved to keep it apart from others

  bool hasOwnGRatio() const { return !std::isnan(this->ownGRatio); }
  /// Tells whether the fibre is an axon without myelin.
  bool isBare() const { return this->ownGRatio == bareGRatio; }
  /// Returns the part of the myelin's volume that is lacking.
  double lostMyelin() const
  {
    const double left = this->outerReport.volume - this->innerReport.volume;
    return this->wholeMyelin > 0.0 && this->innerReport.volume > 0.0 ? 1.0 - left / this->wholeMyelin : 0.0;
  }
  /// Combine the values of both surfaces.
  double largestMove() const { return std::max(this->outerChange.largestMove, this->innerChange.largestMove); }
  double droppedVolume() const { return this->outerChange.droppedVolume + this->innerChange.droppedVolume; }
};

/// Lists all of a pair but its meshes, see base/Bytes.h.
inline auto membersOf(FibreSurfacePair& pair)
{
  return std::tie(pair.fibreId, pair.bundleId, pair.targetRadius, pair.outerReport, pair.innerReport, pair.outerChange,
    pair.innerChange, pair.state, pair.volumeAsMade, pair.outerLevel, pair.thickness, pair.ownGRatio, pair.targetGRatio,
    pair.nodes, pair.internodeLength, pair.wholeMyelin, pair.gRatio, pair.isWanted, pair.isFlawed, pair.isInnerMade,
    pair.isMoved);
}

} // namespace cactus
