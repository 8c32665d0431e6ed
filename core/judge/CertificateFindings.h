// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "judge/SubstrateStatistics.h"
#include "mesh/SurfaceCheck.h"

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace cactus
{

/// The findings on one fibre. Values that need a missing surface, neighbour or centre line are NaN, or 0 for counts.
struct FibreCertificate
{
  int fibreId = 0;
  int bundleId = 0;
  bool hasOuter = false;
  bool hasInner = false;
  SurfaceReport outer;
  SurfaceReport inner;
  bool isBare = false;                    ///< an axon without myelin: both surfaces are the same, to the bit
  std::size_t outerSelfIntersections = 0; ///< pairs of triangles, see selfIntersections(); at most 10,000 are counted
  std::size_t innerSelfIntersections = 0;
  bool outerSelfNested = false; ///< whether a piece of the surface lies inside another one of its pieces
  bool innerSelfNested = false;
  std::size_t meetingFibres = 0; ///< fibres whose outer surfaces cut, touch or contain this one's, or lie inside it
  bool innerLeaves = false;      ///< whether the inner surface cuts or touches its outer one, or has a piece that does not lie
                                 ///< inside it
  double gap = 0.0;              ///< µm, smallest distance to the outer surface of another fibre
  int nearestFibre = 0;          ///< the fibre at that distance; the smaller id of two at the same
  double myelinThickness = 0.0;  ///< µm, smallest distance of the inner surface to the outer one's wall, without its caps
  double length = 0.0;           ///< µm, of the centre line in the domain; NaN without one, like the radii
  RadiusAlongFibre outerRadius;
  RadiusAlongFibre innerRadius;
  double gRatio = 0.0; ///< sqrt(inner volume / outer volume)
};

/// Lists all of a fibre's findings, see base/Bytes.h.
inline auto membersOf(FibreCertificate& fibre)
{
  return std::tie(fibre.fibreId, fibre.bundleId, fibre.hasOuter, fibre.hasInner, fibre.outer, fibre.inner, fibre.isBare,
    fibre.outerSelfIntersections, fibre.innerSelfIntersections, fibre.outerSelfNested, fibre.innerSelfNested, fibre.meetingFibres,
    fibre.innerLeaves, fibre.gap, fibre.nearestFibre, fibre.myelinThickness, fibre.length, fibre.outerRadius, fibre.innerRadius,
    fibre.gRatio);
}

/// The findings on a substrate, and the verdict. All yes-or-no answers come from exact predicates; none depends on rounding.
struct SubstrateCertificate
{
  bool outerJudged = false; ///< whether there were outer surfaces to judge; fibres without one are counted below
  bool innerJudged = false; ///< the same for inner ones
  std::size_t outerSurfaces = 0;
  std::size_t innerSurfaces = 0;
  std::size_t notClosed = 0;        ///< surfaces, outer or inner, with an edge that does not belong to exactly two triangles, in
                                    ///< opposite senses
  std::size_t notManifold = 0;      ///< surfaces that are closed but pinched in a point, or use a corner twice
  std::size_t notOutward = 0;       ///< surfaces with a component that encloses no positive volume
  std::size_t selfIntersecting = 0; ///< surfaces that cut, touch or fold onto themselves
  std::size_t selfNested = 0;       ///< surfaces with one piece inside another
  std::size_t meetingPairs = 0;     ///< pairs of fibres whose outer surfaces cut or touch each other
  std::size_t nestedPairs = 0;      ///< pairs of fibres, one of which has a piece inside the other
  std::size_t leavingInner = 0;     ///< inner surfaces that do not lie strictly inside their outer ones
  std::size_t wantedFibres = 0;     ///< fibres with a surface, or that were to have one
  std::size_t withoutOuter = 0;     ///< of these, without an outer surface
  std::size_t withoutInner = 0;     ///< with an outer surface, but no inner one: myelin throughout; no fault
  std::size_t bare = 0;             ///< fibres without myelin
  std::size_t thinMyelin = 0;       ///< fibres whose myelin is thinner than their maker promised
  double promisedGap = 0.0;         ///< µm, as promised by their maker; 0 without a promise
  double requiredGap = 0.0;         ///< µm, minimumGap
  double smallestGap = 0.0;         ///< µm, between the outer surfaces of two fibres; NaN for a single one
  int gapFibreA = 0;
  int gapFibreB = 0;
  double smallestMyelin = 0.0; ///< µm, smallest distance of an inner surface to the wall of its outer one
  int myelinFibre = 0;
  double smallestFeature = 0.0; ///< µm, smallest altitude of a triangle; no edge is shorter
  double largestAspect = 0.0;   ///< longest edge of a triangle over the altitude on it
  double largestSquaredEdgeRatio = 0.0;
  double largestNormalAngle = 0.0; ///< degrees, see SurfaceReport
  double reach = 0.0; ///< µm by which surfaces reach out of the domain; above 0.1 fractions are NaN, and a remark says so
  double fibreVolumeFraction = 0.0;
  double axonVolumeFraction = 0.0;
  double myelinVolumeFraction = 0.0;
  double aggregateGRatio = 0.0;
  std::size_t triangles = 0;
  double trianglesPerArea = 0.0;        ///< µm⁻²
  std::vector<std::string> faults;      ///< reasons against certification, a sentence each
  std::vector<std::string> remarks;     ///< unmeasured quantities and why, a sentence each; no part of the verdict
  std::vector<FibreCertificate> fibres; ///< every fibre with a surface, or that was to have one, by increasing id

  /// Tells whether every surface is a closed, outward 2-manifold that neither meets nor contains a part of itself, no two outer
  /// surfaces meet or lie inside one another, every inner surface lies strictly inside its outer one (or is it, of an axon
  /// without myelin), fibres keep the required gap, no fibre lacks an outer surface that it was to have, and myelin is as thick
  /// as its maker promised.
  bool certified() const { return this->faults.empty(); }
  /// Returns the faults in one sentence; "certified" without any.
  std::string verdict() const;
  /// Returns which kind of surfaces was judged, as words that follow "certified": empty if both were, else "for its outer
  /// surfaces alone, as there are no inner ones" or the reverse.
  std::string scope() const;
};

} // namespace cactus
