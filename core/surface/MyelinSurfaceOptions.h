// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "base/Properties.h"
#include "surface/GRatio.h"

#include <cstdint>
#include <vector>

namespace cactus
{

struct Fibres;
struct FibreRadialGrowthOptions;

/// µm that surfaces of two fibres keep from each other, and inner surfaces from outer ones, however little is asked for: a
/// simulator's walls have that thickness (MC/DC: 1 nm).
constexpr double leastSeparation = 0.001;

/// Parameters of the surfaces; lengths in µm.
struct MyelinSurfaceOptions
{
  GRatioModel model = GRatioModel::Constant;
  /// The ratio of inner to outer diameter (Constant, 0.05 to 0.99), or its mean (Distributed, 0.3 to 0.95).
  double gRatio = 0.7;
  /// Standard deviation of the g-ratio (Distributed), in [0, 0.3].
  double gRatioDeviation = 0.04;
  /// Fraction of the box that the axons are to fill (TargetAxonVolumeFraction), 0.0001 to 0.999.
  double targetAxonVolumeFraction = 0.0;
  /// Passes of smoothing of the fields before they are contoured (see SmoothedField), 0 to 20 (see Limits.h); 0: none.
  int smoothingIterations = 2;
  /// Distance by which coarsening may move a surface, at most the tolerance that growth kept, as an aim and no strict bound (see
  /// myelinSurfaces()); 0: surfaces stay as contoured.
  double decimationError = 0.005;
  /// Degrees that the angles of triangles are to have at least, for finite elements, 5 to 25 (see remesh()); 0: as coarsening
  /// leaves them.
  double minimumAngle = 0.0;
  /// Cut fibres off at the faces of the domain, else where the image ends.
  bool clipToDomain = true;
  std::uint64_t seed = 1;

  static const PropertyList<MyelinSurfaceOptions>& properties();
};

/// Throws InvalidInput, naming the parameter, for a value out of range.
void validate(const MyelinSurfaceOptions& options);

/// Throws InvalidInput where coarsening would move surfaces further than growth has left room for, its SurfaceTolerance (µm).
void requireDecimationRoom(const MyelinSurfaceOptions& options, double surfaceTolerance);

/// What comes with a label image; lengths in µm.
struct LabelImageFacts
{
  Domain domain;
  double minimumGap = 0.0;         ///< least distance between the surfaces of two fibres that growth kept
  double surfaceTolerance = 0.0;   ///< room that growth left beside the gap, on either side, for moving surfaces
  std::vector<int> fibreIds;       ///< all fibres whose surfaces are to be made, unique, in any order
  std::vector<int> bundleIds;      ///< one per fibre
  std::vector<double> targetRadii; ///< one per fibre
  /// µm of each fibre's centre line inside the domain: one of 0 only passes by outside. Empty where that is not known.
  std::vector<double> lengths;
  bool isSample = false; ///< the image has other fibres, too, of which no surfaces are made
};

/// Of the image that these options grow from the fibres. Lengths are left open.
LabelImageFacts labelImageFacts(const Fibres& fibres, const FibreRadialGrowthOptions& growth);

} // namespace cactus
