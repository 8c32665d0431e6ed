// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Context.h"
#include "DirectionDistribution.h"
#include "Fibres.h"
#include "RadiusDistribution.h"

#include <cstdint>
#include <string>

namespace cactus
{

/// How two crossing bundles share the space. In both styles a fibre stays within its layer from end to end, so straight fibres of
/// different bundles never meet.
enum class CrossingStyle
{
  Interwoven, ///< thin layers of random thickness, one or two fibres thick, alternating in y
  Sheets      ///< few layers of equal thickness
};

/// What initialiseBundles is to make. Lengths in µm, angles in degrees.
struct BundleInitializerOptions
{
  double side = 30.0; ///< side of the cubic domain [-side/2, side/2]³
  /// In (0, 1). One bundle: area of the circles on the end faces over the area of the faces. Two bundles, whose faces lie outside
  /// the domain: volume of the capsules within the domain (see capsuleVolumeInDomain) over that of the domain.
  double fibreVolumeFraction = 0.7;
  RadiusDistributionOptions radius; ///< of the fibres' outer radii
  /// Fraction of the domain that growth is to fill later, at least fibreVolumeFraction. Capsules are then thinner than the
  /// sampled target radii by sqrt(fibreVolumeFraction / this), so that the grown fibres have these; 0: capsules have the target
  /// radii.
  double grownFibreVolumeFraction = 0.0;
  double meanDispersion = 5.0; ///< mean angle between end-to-end direction and bundle axis, in [0, 45]
  /// Coherent is for one bundle. The layers of two crossing bundles are too thin for a flow; their fibres are then drawn as with
  /// Watson.
  DispersionModel dispersionModel = DispersionModel::Coherent;
  /// Distance over which the directions of DispersionModel::Coherent are alike (see CoherentFlow); 0: four times the mean shift
  /// of the fibres from face to face, at least a 32nd of the face.
  double correlationLength = 0.0;
  int numberOfBundles = 1;     ///< 1 or 2
  double crossingAngle = 90.0; ///< between the axes of two bundles, in (0, 90]
  CrossingStyle crossingStyle = CrossingStyle::Interwoven;
  /// Least thickness of each layer of CrossingStyle::Sheets; 0: a sixth of the region's height, or what the largest radius needs.
  double sheetThickness = 0.0;
  /// Width by which the fibres extend laterally beyond each side of the domain (for two bundles on all sides), so that the domain
  /// can be cut from the middle of what the optimiser spreads.
  double margin = 0.0;
  /// Distance between the control points of a fibre, as a multiple of its radius, within the two limits below. A capsule chain
  /// bends once per control point, so the spacing bounds how sharply a fibre can give way; longer capsules are cheaper.
  double spacingFactor = 1.25;
  double minimumSpacing = 0.8; ///< µm
  double maximumSpacing = 2.0; ///< µm
  std::uint64_t seed = 1;

  /// Throws InvalidInput, naming the property, unless every value is finite and within its range (see Limits.h).
  void validate() const;
  /// Radius of the capsules over the sampled target radius.
  double thinning() const;
  /// All parameters as "Name=value" separated by blanks, under the names of the ParaView properties.
  std::string describe() const;
};

/// What came of it, over all bundles.
struct BundleInitializerReport
{
  double fibreVolumeFraction = 0.0; ///< as the option of that name measures it
  double meanDispersion = 0.0;      ///< degrees, to the nominal axes
};

/// One bundle along +z, or two crossing in the x–z plane at ±crossingAngle/2 from +z: straight fibres, each with its sampled
/// radius, whose circles do not overlap on either end face and lie wholly inside it. Between the faces fibres may overlap;
/// undoing that is CapsuleOptimizer's part.
///
/// The radii are drawn until the density is met (see drawRadii). On the first face circles are placed largest first and
/// relaxed (see CirclePacking.h). With DispersionModel::Coherent a random flow (see CoherentFlow.h) then carries their middles
/// to the opposite face. Else each fibre draws its angle from the dispersion model, and its end is placed on the ring
/// that this angle leaves on the opposite face, at the first of several random azimuths that is free, or least crowded. These
/// circles are relaxed too. Their displacements are rescaled, and relaxed again, until the mean angle is within 0.05° (and 2 %)
/// of meanDispersion and, as far as that is possible (usually to 0.1°), the mean direction is the axis. A fibre is never left
/// out.
///
/// The faces of a single bundle are z = ±side/2, exactly. A crossing bundle's faces bound a cuboid that covers the whole domain
/// (and margin) and is divided into the layers of its crossing style along y.
///
/// Throws InvalidInput (see validate; also where the largest fibre does not fit), Infeasible with the value reached where density
/// or dispersion cannot be met, OutOfMemory, Cancelled. Same bits on any number of threads.
Fibres initialiseBundles(
  const BundleInitializerOptions& options, const Context& context = {}, BundleInitializerReport* report = nullptr);

} // namespace cactus
