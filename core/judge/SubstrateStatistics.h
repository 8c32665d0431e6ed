// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Properties.h"
#include "fibres/Fibres.h"
#include "mesh/FibreSurfaces.h"
#include "mesh/SurfaceCheck.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// How a substrate is measured.
struct SubstrateStatisticsOptions
{
  /// µm between two cross-sections along a fibre's centre line (paper, "Experiments": 1 µm).
  double cutSpacing = 1.0;
  /// µm that a surface may reach out of the domain, as the rounding of a clip does; not negative.
  double clipTolerance = 0.1;

  static const PropertyList<SubstrateStatisticsOptions>& properties();
  /// Throws InvalidInput naming the property.
  void validate() const;
};

/// The cross-sections of one surface along its fibre. The equivalent radius of a cut is that of the circle of the same area.
struct RadiusAlongFibre
{
  std::size_t cuts = 0;     ///< cross-sections that lie wholly inside the domain; without any, the others are NaN
  double mean = 0.0;        ///< µm, of the equivalent radius
  double deviation = 0.0;   ///< µm, standard deviation of the equivalent radius along the fibre
  double circularity = 0.0; ///< mean of 4π · area / perimeter²: 1 for circles, 0.91 for hexagons, 0.79 for squares
};

/// What is measured on one fibre. A surface that the fibre has not leaves a report of zeros and NaN radii.
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
  double gRatio = 0.0; ///< gRatioOf() the two volumes, NaN without both surfaces
};

/// sqrt(inner / outer volume); 0 unless both are positive, as those of closed, outward surfaces are.
double gRatioOf(double innerVolume, double outerVolume);

/// What is measured on the whole. Fractions are volumes of the surfaces, which have to be clipped to the domain, over the
/// domain's. What needs a set of surfaces that is not given (see FibreSurfaces) is NaN; of a set without a surface it is 0.
struct SubstrateStatistics
{
  double fibreVolumeFraction = 0.0;   ///< outer surfaces
  double axonVolumeFraction = 0.0;    ///< inner surfaces
  double myelinVolumeFraction = 0.0;  ///< the difference: a fibre without an inner surface is myelin throughout
  double aggregateGRatio = 0.0;       ///< sqrt(1 - MVF / FVF), Stikov 2015; 0 without fibres
  double capsuleVolumeFraction = 0.0; ///< of the capsules, overlaps twice
  double largestPenetration = 0.0;    ///< D = 1 - d / (rp + rq) over all pairs of capsules of different fibres; 0 without overlap
  double meanDispersion = 0.0;        ///< degrees, end to end
  double tangentDispersion = 0.0;     ///< degrees, by segment
  double meanTargetRadius = 0.0;      ///< µm, over fibres
  double meanOuterRadius = 0.0;       ///< µm, over fibres that have a cross-section
  double meanInnerRadius = 0.0;       ///< µm, over fibres that have a cross-section
  std::size_t outerClosed = 0;        ///< closed 2-manifolds that point outward
  std::size_t outerOpen = 0;          ///< the other outer surfaces
  std::size_t innerClosed = 0;
  std::size_t innerOpen = 0;
  std::size_t triangles = 0;
  double trianglesPerArea = 0.0;        ///< µm⁻², over all surfaces
  double smallestAngle = 0.0;           ///< degrees, over all surfaces
  double largestSquaredEdgeRatio = 0.0; ///< over all surfaces
  std::vector<FibreStatistics> fibres;  ///< in the order of the fibres given
};

/// Measures a substrate on its final surfaces, fibre by fibre in parallel. Either set of surfaces may be empty; surfaces belong
/// to fibres by id.
///
/// Throws InvalidInput, naming the fibre, where a surface belongs to no fibre or reaches out of the domain by more than
/// clipTolerance, and as `validate` does; Cancelled when stopped.
SubstrateStatistics measureSubstrate(const Fibres& fibres, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const SubstrateStatisticsOptions& options = {}, const Context& context = {});

/// Equivalent radius and circularity of the surface at every `spacing` µm along fibre number `fibre`'s centre line, from cuts
/// orthogonal to it. Cuts that reach the domain's boundary, or around a point that lies outside the surface, do not count.
/// Throws InvalidInput for a spacing out of range, or with which there would be more than limits::cuts cuts.
RadiusAlongFibre radiusAlongFibre(const Fibres& fibres, std::size_t fibre, const TriangleMesh& surface, double spacing);

/// Length (µm) of fibre number `fibre`'s centre line inside the domain.
double lengthInDomain(const Fibres& fibres, std::size_t fibre);

/// How many of the values lie in each of `bins` equal parts of [lower, upper]; the last part holds `upper` too. NaN and values
/// outside count nowhere. Throws InvalidInput, naming NumberOfBins, unless there are 1 to 10000.
std::vector<std::size_t> histogram(const std::vector<double>& values, double lower, double upper, std::size_t bins);

} // namespace cactus
