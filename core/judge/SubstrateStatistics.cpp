// SPDX-License-Identifier: BSD-3-Clause
#include "judge/SubstrateStatistics.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Parallel.h"
#include "mesh/CrossSection.h"
#include "optimiser/OverlapReport.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

namespace cactus
{

namespace
{

/// µm. An outline nearer to the domain's boundary has been cut off by it; above the rounding of single-precision coordinates.
constexpr double boundaryTolerance = 1e-3;

/// The position (µm) at arc length `s` along a fibre's centre line, whose cumulative lengths are `arc`.
Eigen::Vector3d positionAt(const Fibres& fibres, std::size_t fibre, const std::vector<double>& arc, double s)
{
  const auto after = std::upper_bound(arc.begin() + 1, arc.end() - 1, s);
  const auto segment = static_cast<std::size_t>(after - arc.begin()) - 1;
  const double weight = std::clamp((s - arc[segment]) / (arc[segment + 1] - arc[segment]), 0.0, 1.0);
  const std::size_t first = fibres.offsets[fibre] + segment;
  return (1.0 - weight) * fibres.points[first] + weight * fibres.points[first + 1];
}

/// Index of every surface by fibre id, all of which have to be fibres'.
std::unordered_map<int, std::size_t> indexOf(const FibreSurfaces& surfaces, const Fibres& fibres, const std::string& port)
{
  std::unordered_map<int, std::size_t> index;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    index[surfaces.fibreIds[i]] = i;
  }
  std::unordered_map<int, std::size_t> unclaimed = index;
  for (const int id : fibres.fibreIds)
  {
    unclaimed.erase(id);
  }
  if (!unclaimed.empty())
  {
    const auto first = std::min_element(unclaimed.begin(), unclaimed.end());
    throw InvalidInput(port + " holds a surface of fibre " + std::to_string(first->first) +
                       ", which Fibres does not hold: connect the fibres that the surfaces were made from");
  }
  return index;
}

void requireClipped(const TriangleMesh& mesh, const Domain& domain, double tolerance, const std::string& what)
{
  for (const Eigen::Vector3d& point : mesh.points)
  {
    if (domain.depth(point) < -tolerance)
    {
      throw InvalidInput(what + " reaches " + text(-domain.depth(point)) +
                         " µm out of the domain, so that its volume is no fraction of it: turn on ClipToDomain in MyelinSurface, "
                         "or clip it with closed caps first");
    }
  }
}

/// Mean of what is finite, in order; NaN where nothing is.
template <typename Value>
double meanOver(const std::vector<FibreStatistics>& fibres, Value&& value)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (const FibreStatistics& fibre : fibres)
  {
    if (std::isfinite(value(fibre)))
    {
      sum += value(fibre);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : notANumber;
}

} // namespace

double gRatioOf(double innerVolume, double outerVolume)
{
  return innerVolume > 0.0 && outerVolume > 0.0 ? std::sqrt(innerVolume / outerVolume) : 0.0;
}

const PropertyList<SubstrateStatisticsOptions>& SubstrateStatisticsOptions::properties()
{
  using Options = SubstrateStatisticsOptions;
  static const auto list =
    PropertyList<Options>()
      .add("CutSpacing", &Options::cutSpacing, limits::cutSpacing, "Distance between two cross-sections along a fibre")
      .add("ClipTolerance", &Options::clipTolerance, limits::clipTolerance, "What a surface may reach out of the domain")
      .use(PropertyUse::Code);
  return list;
}

void SubstrateStatisticsOptions::validate() const
{
  validateProperties(*this);
}

double lengthInDomain(const Fibres& fibres, std::size_t fibre)
{
  double length = 0.0;
  for (std::size_t i = fibres.offsets[fibre]; i + 1 < fibres.offsets[fibre + 1]; ++i)
  {
    const auto [from, to] = fibres.domain.clip(fibres.points[i], fibres.points[i + 1]);
    length += std::max(0.0, to - from) * (fibres.points[i + 1] - fibres.points[i]).norm();
  }
  return length;
}

RadiusAlongFibre radiusAlongFibre(const Fibres& fibres, std::size_t fibre, const TriangleMesh& surface, double spacing)
{
  std::vector<double> arc{ 0.0 };
  for (std::size_t i = fibres.offsets[fibre]; i + 1 < fibres.offsets[fibre + 1]; ++i)
  {
    arc.push_back(arc.back() + (fibres.points[i + 1] - fibres.points[i]).norm());
  }
  requireWithin("CutSpacing", spacing, limits::cutSpacing);
  if (!(arc.back() / spacing <= limits::cuts))
  {
    throw InvalidInput(text("CutSpacing ", spacing, " µm makes more than ", limits::cuts, " cross-sections of fibre ",
      fibres.fibreIds[fibre], ", whose centre line is ", arc.back(), " µm long: choose a larger CutSpacing"));
  }
  const CrossSections sections(surface);
  std::vector<double> radii;
  double circularities = 0.0;
  for (std::size_t cut = 0; (static_cast<double>(cut) + 0.5) * spacing < arc.back(); ++cut)
  {
    const double s = (static_cast<double>(cut) + 0.5) * spacing;
    const Eigen::Vector3d point = positionAt(fibres, fibre, arc, s);
    // The chord over one spacing, so that a kink between two short segments does not tilt the plane.
    const Eigen::Vector3d chord = positionAt(fibres, fibre, arc, std::min(s + 0.5 * spacing, arc.back())) -
                                  positionAt(fibres, fibre, arc, std::max(s - 0.5 * spacing, 0.0));
    if (fibres.domain.depth(point) <= 0.0 || chord.norm() <= 0.0)
    {
      continue;
    }
    const Eigen::Vector3d normal = chord.normalized();
    const auto outline = sections.outlineAround(point, normal, 3.0 * fibres.targetRadii[fibre]);
    const bool whole = std::all_of(outline.begin(), outline.end(),
      [&](const Eigen::Vector3d& corner) { return fibres.domain.depth(corner) > boundaryTolerance; });
    if (!outline.empty() && whole)
    {
      const double area = polygonArea(outline, normal);
      const double perimeter = polygonPerimeter(outline);
      radii.push_back(std::sqrt(area / pi));
      circularities += 4.0 * pi * area / (perimeter * perimeter);
    }
  }

  RadiusAlongFibre result{ radii.size(), notANumber, notANumber, notANumber };
  if (!radii.empty())
  {
    double sum = 0.0;
    for (const double radius : radii)
    {
      sum += radius;
    }
    result.mean = sum / static_cast<double>(radii.size());
    result.circularity = circularities / static_cast<double>(radii.size());
    double squares = 0.0;
    for (const double radius : radii)
    {
      squares += (radius - result.mean) * (radius - result.mean);
    }
    result.deviation = std::sqrt(squares / static_cast<double>(radii.size()));
  }
  return result;
}

namespace
{

void measureSurface(const Fibres& fibres, std::size_t fibre, const TriangleMesh& mesh, const std::string& what,
  const SubstrateStatisticsOptions& options, SurfaceReport& report, RadiusAlongFibre& radius)
{
  try
  {
    report = checkSurface(mesh);
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput(what + ": " + error.what());
  }
  requireClipped(mesh, fibres.domain, options.clipTolerance, what);
  radius = radiusAlongFibre(fibres, fibre, mesh, options.cutSpacing);
}

/// What the surfaces of all fibres come to; of surfaces that are not given fractions are NaN.
void sumUpSurfaces(const Domain& domain, bool hasOuter, bool hasInner, SubstrateStatistics& result)
{
  // Sums in the order of the fibres: the same bits on any number of threads.
  double outerVolume = 0.0;
  double innerVolume = 0.0;
  double area = 0.0;
  result.smallestAngle = notANumber;
  result.largestSquaredEdgeRatio = notANumber;
  for (const FibreStatistics& fibre : result.fibres)
  {
    outerVolume += fibre.outer.volume;
    innerVolume += fibre.inner.volume;
    area += fibre.outer.area + fibre.inner.area;
    result.triangles += fibre.outer.triangles + fibre.inner.triangles;
    result.outerClosed += fibre.hasOuter && fibre.outer.sound() ? 1 : 0;
    result.outerOpen += fibre.hasOuter && !fibre.outer.sound() ? 1 : 0;
    result.innerClosed += fibre.hasInner && fibre.inner.sound() ? 1 : 0;
    result.innerOpen += fibre.hasInner && !fibre.inner.sound() ? 1 : 0;
    for (const SurfaceReport* report : { &fibre.outer, &fibre.inner })
    {
      if (report->triangles > 0)
      {
        result.smallestAngle = std::fmin(result.smallestAngle, report->smallestAngle);
        result.largestSquaredEdgeRatio = std::fmax(result.largestSquaredEdgeRatio, report->largestSquaredEdgeRatio);
      }
    }
  }
  const double domainVolume = domain.volume();
  const bool hasBoth = hasOuter && hasInner;
  result.fibreVolumeFraction = hasOuter ? outerVolume / domainVolume : notANumber;
  result.axonVolumeFraction = hasInner ? innerVolume / domainVolume : notANumber;
  result.myelinVolumeFraction = hasBoth ? (outerVolume - innerVolume) / domainVolume : notANumber;
  result.aggregateGRatio = !hasBoth ? notANumber
                           : outerVolume > 0.0
                             ? std::sqrt(std::max(0.0, 1.0 - result.myelinVolumeFraction / result.fibreVolumeFraction))
                             : 0.0;
  result.trianglesPerArea = area > 0.0 ? static_cast<double>(result.triangles) / area : notANumber;
}

} // namespace

SubstrateStatistics measureSubstrate(const Fibres& fibres, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const SubstrateStatisticsOptions& options, const Context& context)
{
  options.validate();
  validate(fibres);
  const auto outerIndex = indexOf(outer, fibres, "Outer");
  const auto innerIndex = indexOf(inner, fibres, "Inner");

  SubstrateStatistics result;
  result.fibres.resize(fibres.size());
  parallelFor(
    fibres.size(), context,
    [&](std::size_t f)
    {
      FibreStatistics& fibre = result.fibres[f];
      fibre.fibreId = fibres.fibreIds[f];
      fibre.bundleId = fibres.bundleIds[f];
      fibre.targetRadius = fibres.targetRadii[f];
      fibre.length = lengthInDomain(fibres, f);
      const auto measure = [&](const FibreSurfaces& surfaces, const std::unordered_map<int, std::size_t>& index,
                             const std::string& name, SurfaceReport& report, RadiusAlongFibre& radius)
      {
        const auto found = index.find(fibre.fibreId);
        radius = { 0, notANumber, notANumber };
        if (found != index.end())
        {
          const std::string what = "the " + name + " surface of fibre " + std::to_string(fibre.fibreId);
          measureSurface(fibres, f, surfaces.mesh(found->second), what, options, report, radius);
        }
        return found != index.end();
      };
      fibre.hasOuter = measure(outer, outerIndex, "outer", fibre.outer, fibre.outerRadius);
      fibre.hasInner = measure(inner, innerIndex, "inner", fibre.inner, fibre.innerRadius);
      fibre.gRatio = fibre.hasOuter && fibre.hasInner ? gRatioOf(fibre.inner.volume, fibre.outer.volume) : notANumber;
    },
    "Measuring surfaces");

  sumUpSurfaces(fibres.domain, outer.given(), inner.given(), result);
  result.capsuleVolumeFraction = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
  result.largestPenetration = measureOverlap(fibres, 0.0, context.threadCount()).largestPenetration;
  result.meanDispersion = meanDispersion(fibres);
  result.tangentDispersion = meanTangentDispersion(fibres);
  result.meanTargetRadius = meanOver(result.fibres, [](const FibreStatistics& f) { return f.targetRadius; });
  result.meanOuterRadius = meanOver(result.fibres, [](const FibreStatistics& f) { return f.outerRadius.mean; });
  result.meanInnerRadius = meanOver(result.fibres, [](const FibreStatistics& f) { return f.innerRadius.mean; });
  return result;
}

std::vector<std::size_t> histogram(const std::vector<double>& values, double lower, double upper, std::size_t bins)
{
  requireWithin("NumberOfBins", static_cast<double>(bins), limits::bins);
  std::vector<std::size_t> counts(bins, 0);
  for (const double value : values)
  {
    if (value >= lower && value <= upper)
    {
      const double part = upper > lower ? (value - lower) / (upper - lower) : 1.0;
      const auto bin = static_cast<std::size_t>(part * static_cast<double>(bins));
      ++counts[std::min(bin, bins - 1)];
    }
  }
  return counts;
}

} // namespace cactus
