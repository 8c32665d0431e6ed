// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Properties.h"
#include "fibres/Fibres.h"
#include "judge/DirectionStatistics.h"
#include "judge/ExtraAxonalWalk.h"
#include "judge/FibreProfile.h"
#include "mesh/FibreSurfaces.h"
#include "mesh/SurfaceCheck.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// Options of the measurement.
struct SubstrateStatisticsOptions
{
  /// Distance (µm) between two cross-sections along a fibre's centre line (paper, "Experiments": 1 µm).
  double cutSpacing = 1.0;
  /// Distance (µm) by which a surface may reach out of the domain, as after the rounding of a clip; not negative.
  double clipTolerance = 0.1;
  ExtraAxonalWalkOptions walk;

  static const PropertyList<SubstrateStatisticsOptions>& properties();
  /// Throws InvalidInput naming the property.
  void validate() const;
};

/// The measures of one fibre. A missing surface gives a report of zeros and NaN radii. Radii are those of radiusAlongFibre().
struct FibreStatistics
{
  int fibreId = 0;
  int bundleId = 0;
  double targetRadius = 0.0; ///< µm
  double length = 0.0;       ///< µm, of the centre line inside the domain
  bool hasOuter = false;
  bool hasInner = false;
  SurfaceReport outer;
  SurfaceReport inner;
  RadiusAlongFibre outerRadius;
  RadiusAlongFibre innerRadius;
  double gRatio = 0.0; ///< gRatioOf() the two volumes, NaN without both surfaces; 1 of an axon without myelin only
  CentreLineShape line;
  double outerWallArea = 0.0; ///< µm², without the caps by which the domain ends the surface
  double innerWallArea = 0.0; ///< µm²
  AxonShape axon;             ///< of the inner surface
  std::vector<FibreCut> outerCuts;
  std::vector<FibreCut> innerCuts;

  /// Returns the standard deviation of the cuts' g-ratios, of diameters, along the fibre; NaN where none cuts both surfaces.
  double gRatioDeviation() const;
  double outerCalibreVariation() const { return this->outerRadius.deviation / this->outerRadius.mean; }
  double innerCalibreVariation() const { return this->innerRadius.deviation / this->innerRadius.mean; }
  /// Returns the area of the axon's wall over its volume (µm⁻¹): 2/r for a straight circular one; NaN without an axon.
  double axonSurfaceToVolume() const;
};

/// Returns sqrt(inner / outer volume); 0 unless both are positive, as for closed, outward surfaces.
double gRatioOf(double innerVolume, double outerVolume);

/// The measures of the whole substrate. Fractions are volumes of the surfaces, which have to be clipped to the domain, over the
/// domain's. Values that need a set of surfaces that is not given (see FibreSurfaces) are NaN; for an empty set they are 0.
///
/// Means over fibres are weighted by the fibres' lengths in the domain: those of a sample cut from a larger tissue are then
/// unbiased estimates of the tissue's, by fibre length (cf. Baddeley and Jensen 2005, Stereology for Statisticians). A fibre that
/// only grazes the domain counts little, and not at all where its centre line stays outside.
struct SubstrateStatistics
{
  double fibreVolumeFraction = 0.0;   ///< outer surfaces
  double axonVolumeFraction = 0.0;    ///< inner surfaces
  double myelinVolumeFraction = 0.0;  ///< the difference: a fibre without an inner surface is myelin throughout
  double unmyelinatedFraction = 0.0;  ///< of the axons whose outer surface is their inner one
  double axonalWaterFraction = 0.0;   ///< AVF / (1 - MVF): that of the water which is not in myelin
  double aggregateGRatio = 0.0;       ///< sqrt(1 - MVF / FVF), Stikov 2015; 0 without fibres
  double capsuleVolumeFraction = 0.0; ///< of the capsules, overlaps counted twice
  double largestPenetration = 0.0;    ///< D = 1 - d / (rp + rq) over all pairs of capsules of different fibres; 0 without overlap
  double meanDispersion = 0.0;        ///< degrees, end to end
  double tangentDispersion = 0.0;     ///< degrees, by segment
  DirectionStatistics directions;
  double meanTargetRadius = 0.0; ///< µm, over fibres
  double meanOuterRadius = 0.0;  ///< µm, over fibres with an outer surface, see radiusAlongFibre()
  double meanInnerRadius = 0.0;  ///< µm, over fibres with an inner surface
  std::size_t outerClosed = 0;   ///< closed 2-manifolds that point outward
  std::size_t outerOpen = 0;     ///< the other outer surfaces
  std::size_t innerClosed = 0;
  std::size_t innerOpen = 0;
  std::size_t triangles = 0;
  double trianglesPerArea = 0.0;        ///< µm⁻², over all surfaces
  double smallestAngle = 0.0;           ///< degrees, over all surfaces
  double largestSquaredEdgeRatio = 0.0; ///< over all surfaces
  double meanSinuosity = 0.0;           ///< over fibres that have one, like the next nine
  double meanUndulation = 0.0;          ///< µm, CentreLineShape::undulation
  double meanOuterAxisRatio = 0.0;
  double meanInnerAxisRatio = 0.0;
  double meanOuterCalibreVariation = 0.0;
  double meanInnerCalibreVariation = 0.0;
  double meanDiffusivityRatio = 0.0;   ///< AxonShape::diffusivityRatio
  double meanAreaFluctuation = 0.0;    ///< µm, AxonShape::areaFluctuation: an estimate of Γ(k → 0)
  double meanBeadAmplitude = 0.0;      ///< AxonShape::beadAmplitude
  double meanBeadSpacing = 0.0;        ///< µm, AxonShape::beadSpacing
  double effectiveRadius = 0.0;        ///< µm, over all cuts of all axons; one without a cut counts with its radius
  double middleEffectiveRadius = 0.0;  ///< µm, over the middle cut of each axon, as in a section through the bundle
  double intraSurfaceToVolume = 0.0;   ///< µm⁻¹, walls of the axons over their volume
  double extraSurfaceToVolume = 0.0;   ///< µm⁻¹, walls of the outer surfaces over the rest of the domain
  ExtraAxonalDiffusion outside;        ///< if walkers were requested and there are outer surfaces
  std::vector<FibreStatistics> fibres; ///< in the order of the given fibres
};

/// Measures a substrate on its final surfaces, fibre by fibre in parallel. Either set of surfaces may be empty; surfaces belong
/// to fibres by id.
///
/// Throws InvalidInput, naming the fibre, if a surface belongs to no fibre or reaches out of the domain by more than
/// clipTolerance, if walkers are requested and a surface is open, and as `validate` does; OutOfMemory if CutSpacing gives more
/// cuts than fit into memory; Cancelled.
SubstrateStatistics measureSubstrate(const Fibres& fibres, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const SubstrateStatisticsOptions& options = {}, const Context& context = {});

/// One row of a fibre's profile: measures of its surfaces at a cut. Values of a surface that is not cut there are NaN.
struct ProfilePoint
{
  int fibreId = 0;
  double arcLength = 0.0;        ///< µm, along the centre line from its first point
  double outerDiameter = 0.0;    ///< µm, of the circle with the cut's area
  double innerDiameter = 0.0;    ///< µm
  double outerCircularity = 0.0; ///< see FibreCut
  double innerCircularity = 0.0;
  double outerAxisRatio = 0.0; ///< see FibreCut
  double innerAxisRatio = 0.0;
  double myelinThickness = 0.0; ///< µm, half the difference of the diameters
  double gRatio = 0.0;          ///< their ratio
};

/// Returns the points of all fibres, in their order and along each, where at least one surface is cut.
std::vector<ProfilePoint> profilesOf(const std::vector<FibreStatistics>& fibres, double spacing);

/// Counts the values in each of `bins` equal parts of [lower, upper]; the last part includes `upper`. NaN and values outside are
/// not counted. Throws InvalidInput, naming NumberOfBins, unless there are 1 to 10000.
std::vector<std::size_t> histogram(const std::vector<double>& values, double lower, double upper, std::size_t bins);

} // namespace cactus
