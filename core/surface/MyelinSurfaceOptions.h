// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "base/Properties.h"
#include "bundle/Beads.h"
#include "fibres/Fibres.h"
#include "surface/GRatio.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace cactus
{

struct FibreRadialGrowthOptions;

/// Which internodes lose their myelin.
enum class InternodeOrder
{
  Random,
  ThinnestFirst ///< all of thin fibres before any of thicker ones
};

/// Least distance (µm) between surfaces of two fibres, and between inner and outer surfaces, whatever the options: a simulator's
/// walls have that thickness (MC/DC: 1 nm).
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
  /// Make myelin as thick for the fibre's calibre everywhere along it, so that each cross-section has the g-ratio; otherwise it
  /// is equally thick everywhere.
  bool myelinFollowsAxon = false;
  /// How much larger than its mean an axon's radius is in a swelling, as a fraction of that mean, 0.01 to 1; 0: no swellings.
  double swellingAmplitude = 0.0;
  double swellingSpacing = 5.1; ///< mean distance of neighbouring swellings
  double swellingLength = 2.0;  ///< length over which a swelling is higher than half of its height
  /// Length of nodes of Ranvier along the fibre; 0: none.
  double nodeLength = 0.0;
  /// Length of an internode over the fibre's outer diameter.
  double internodeFactor = 100.0;
  /// Length, on either side of a node, over which the myelin and the axon reach their full thickness.
  double paranodeLength = 2.0;
  /// Diameter of the axon in a node over that in the internode beside it.
  double nodeConstriction = 0.7;
  /// Fraction of the internodes that a lesion has taken the myelin of, 0 to 1.
  double internodeLoss = 0.0;
  InternodeOrder internodeOrder = InternodeOrder::Random;
  /// Fraction of these whose myelin has come back, 0 to 1.
  double remyelinatedFraction = 0.0;
  /// The g-ratio there, 0.3 to 0.99; where it is below that of whole internodes, these are as they were.
  double remyelinatedGRatio = 0.85;
  std::uint64_t nodeSeed = 1;
  /// Smoothing passes of the fields before they are contoured (see SmoothedField), 0 to 20 (see Limits.h); 0: none.
  int smoothingIterations = 2;
  /// Distance by which coarsening may move a surface, at most the tolerance that growth kept, as an aim and no strict bound (see
  /// myelinSurfaces()); 0: surfaces stay as contoured.
  double decimationError = 0.005;
  /// Smallest angle of triangles, in degrees, for finite elements, 5 to 25 (see remesh()); 0: no remeshing.
  double minimumAngle = 0.0;
  /// Cut fibres off at the faces of the domain; otherwise where the image ends.
  bool clipToDomain = true;
  std::uint64_t seed = 1;

  static const PropertyList<MyelinSurfaceOptions>& properties();

  bool hasNodes() const { return nodeLength > 0.0; }
  /// Tells whether the depth of the axon in its fibre depends on the place along it, nodes aside.
  bool shapesAxons() const { return myelinFollowsAxon || swellingAmplitude > 0.0; }
  /// Returns the shape of axons with swellings, whose distances vary as those of beads do in healthy axons.
  BeadShape swellings() const;
  /// Tells whether surfaces depend on where along the fibre they are, so that centre lines have to be known.
  bool followsLines() const { return shapesAxons() || hasNodes(); }
};

/// Throws InvalidInput if fibres say how much of their myelin there is, and the g-ratio depends on what is left.
void requireKnownGRatio(const Fibres& fibres, const MyelinSurfaceOptions& options);

/// Throws InvalidInput, naming the parameter, for a value out of range.
void validate(const MyelinSurfaceOptions& options);

/// Throws InvalidInput if coarsening would move surfaces further than growth has left room for, its SurfaceTolerance (µm).
void requireDecimationRoom(const MyelinSurfaceOptions& options, double surfaceTolerance);

/// The data that accompany a label image; lengths in µm.
struct LabelImageFacts
{
  Domain domain;
  double minimumGap = 0.0;         ///< least distance between the surfaces of two fibres that growth kept
  double surfaceTolerance = 0.0;   ///< room that growth left beside the gap, on either side, for moving surfaces
  std::vector<int> fibreIds;       ///< all fibres whose surfaces are to be made, unique, in any order
  std::vector<int> bundleIds;      ///< one per fibre
  std::vector<double> targetRadii; ///< one per fibre
  ColumnTable columns;             ///< of the fibres, see fibreColumns()
  /// Length (µm) of each fibre's centre line inside the domain: 0 for one that only passes outside. Empty if unknown.
  std::vector<double> lengths;
  std::shared_ptr<const Fibres> centreLines; ///< the fibres, for myelin that varies along them; null if unknown
  bool isSample = false;                     ///< the image also has other fibres, of which no surfaces are made

  /// Tells whether the fibres say themselves how much of their myelin there is.
  bool hasMyelinFractions() const { return centreLines != nullptr && !centreLines->myelinFractions.empty(); }
};

/// Returns the thickness (µm) of the wall of myelin that stays in nodes, where a lesion has taken it, and over swellings: the
/// promised one, and room for surfaces that move.
double wallOfMyelin(const LabelImageFacts& facts);

/// Returns the facts of the image that these options grow from the fibres. Lengths are left empty.
LabelImageFacts labelImageFacts(const Fibres& fibres, const FibreRadialGrowthOptions& growth);

} // namespace cactus
