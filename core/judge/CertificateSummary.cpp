// SPDX-License-Identifier: BSD-3-Clause
#include "judge/CertificateSummary.h"

#include "base/Constants.h"
#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace cactus
{

namespace
{

/// Distance (µm) by which a surface may reach out of the domain, as after the rounding of a clip.
constexpr double clipTolerance = 0.1;

void add(SubstrateCertificate& all, bool has, const SurfaceReport& report, std::size_t intersections)
{
  if (!has)
  {
    return;
  }
  all.triangles += report.triangles;
  all.notClosed += report.closed() ? 0 : 1;
  all.notManifold += report.closed() && !report.closedManifold() ? 1 : 0;
  all.notOutward += report.outward() ? 0 : 1;
  all.selfIntersecting += intersections > 0 ? 1 : 0;
  all.smallestFeature = std::fmin(all.smallestFeature, report.smallestAltitude);
  all.largestAspect = std::fmax(all.largestAspect, report.largestAspect);
  all.largestSquaredEdgeRatio = std::fmax(all.largestSquaredEdgeRatio, report.largestSquaredEdgeRatio);
  all.largestNormalAngle = std::fmax(all.largestNormalAngle, report.largestNormalAngle);
}

/// Adds a fibre to counts and extremes; summarise() computes the sums.
void addFibre(SubstrateCertificate& all, const FibreCertificate& fibre)
{
  add(all, fibre.hasOuter, fibre.outer, fibre.outerSelfIntersections);
  add(all, fibre.hasInner, fibre.inner, fibre.innerSelfIntersections);
  all.selfNested += (fibre.outerSelfNested ? 1 : 0) + (fibre.innerSelfNested ? 1 : 0);
  all.leavingInner += fibre.innerLeaves ? 1 : 0;
  all.withoutOuter += fibre.hasOuter ? 0 : 1;
  all.withoutInner += fibre.hasOuter && !fibre.hasInner ? 1 : 0;
  all.bare += fibre.isBare ? 1 : 0;
  all.thinMyelin += fibre.myelinThickness < all.promisedGap ? 1 : 0;
  if (fibre.myelinThickness < all.smallestMyelin || (std::isnan(all.smallestMyelin) && !std::isnan(fibre.myelinThickness)))
  {
    all.smallestMyelin = fibre.myelinThickness;
    all.myelinFibre = fibre.fibreId;
  }
}

/// Names, for a sentence, the first fibre for which `is` holds.
template <typename Is>
std::string first(const SubstrateCertificate& all, Is&& is)
{
  const auto found = std::find_if(all.fibres.begin(), all.fibres.end(), is);
  return found == all.fibres.end() ? std::string() : " (fibre " + std::to_string(found->fibreId) + " first)";
}

} // namespace

void summarise(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, double minimumGap, double reach,
  SubstrateCertificate& all)
{
  all.outerJudged = outer.given();
  all.innerJudged = inner.given();
  all.outerSurfaces = outer.size();
  all.innerSurfaces = inner.size();
  all.requiredGap = minimumGap;
  all.promisedGap = inner.promisedGap;
  all.wantedFibres = all.fibres.size();
  all.reach = reach;
  all.smallestMyelin = all.smallestFeature = all.largestAspect = all.largestSquaredEdgeRatio = notANumber;
  all.largestNormalAngle = notANumber;
  double outerVolume = 0.0;
  double innerVolume = 0.0;
  double area = 0.0;
  for (const FibreCertificate& fibre : all.fibres)
  {
    addFibre(all, fibre);
    outerVolume += fibre.outer.volume;
    innerVolume += fibre.inner.volume;
    area += fibre.outer.area + fibre.inner.area;
  }
  const bool hasOuter = outer.given() && reach <= clipTolerance;
  const bool hasInner = inner.given() && reach <= clipTolerance;
  const double volume = domain.volume();
  all.fibreVolumeFraction = hasOuter ? outerVolume / volume : notANumber;
  all.axonVolumeFraction = hasInner ? innerVolume / volume : notANumber;
  all.myelinVolumeFraction = hasOuter && hasInner ? (outerVolume - innerVolume) / volume : notANumber;
  all.aggregateGRatio = hasOuter && hasInner ? gRatioOf(innerVolume, outerVolume) : notANumber;
  if (reach > clipTolerance)
  {
    all.remarks.push_back(text("surfaces reach ", reach,
      " µm out of the domain, so that their volumes are no fractions of it and none are given: turn on ClipToDomain in "
      "MyelinSurface to have them"));
  }
  all.trianglesPerArea = area > 0.0 ? static_cast<double>(all.triangles) / area : notANumber;
}

void listFaults(SubstrateCertificate& all)
{
  using Fibre = FibreCertificate;
  // Each with the first fibre for which it is true.
  const auto fault = [&all](std::size_t count, const std::string& what, auto&& isOf)
  {
    if (count > 0)
    {
      all.faults.push_back(std::to_string(count) + " " + what + first(all, isOf));
    }
  };
  const auto anySurface = [](auto&& isBad)
  { return [isBad](const Fibre& f) { return (f.hasOuter && isBad(f.outer)) || (f.hasInner && isBad(f.inner)); }; };
  fault(all.withoutOuter, "of " + std::to_string(all.wantedFibres) + " fibres have no outer surface",
    [](const Fibre& f) { return !f.hasOuter; });
  fault(all.notClosed, "surfaces are not closed", anySurface([](const SurfaceReport& r) { return !r.closed(); }));
  fault(all.notManifold, "surfaces are pinched in a point or use a corner twice",
    anySurface([](const SurfaceReport& r) { return r.closed() && !r.closedManifold(); }));
  fault(all.notOutward, "surfaces do not point outward", anySurface([](const SurfaceReport& r) { return !r.outward(); }));
  fault(all.selfIntersecting, "surfaces cut or touch themselves",
    [](const Fibre& f) { return f.outerSelfIntersections + f.innerSelfIntersections > 0; });
  fault(all.selfNested, "surfaces have a piece inside another of their pieces",
    [](const Fibre& f) { return f.outerSelfNested || f.innerSelfNested; });
  fault(all.meetingPairs, "pairs of outer surfaces cut or touch each other", [](const Fibre& f) { return f.gap == 0.0; });
  fault(all.nestedPairs, "pairs of fibres lie inside one another",
    [](const Fibre& f) { return f.meetingFibres > 0 && f.gap != 0.0; });
  fault(all.leavingInner, "inner surfaces leave their outer ones", [](const Fibre& f) { return f.innerLeaves; });
  fault(all.thinMyelin, "fibres have myelin thinner than the " + text(all.promisedGap) + " µm that it was made with",
    [&all](const Fibre& f) { return f.myelinThickness < all.promisedGap; });
  if (all.smallestGap < all.requiredGap && all.meetingPairs == 0)
  {
    all.faults.push_back("fibres " + std::to_string(all.gapFibreA) + " and " + std::to_string(all.gapFibreB) +
                         " come as near as " + text(all.smallestGap) + " µm, less than MinimumGap " + text(all.requiredGap) +
                         " µm");
  }
}

} // namespace cactus
