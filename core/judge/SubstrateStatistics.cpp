// SPDX-License-Identifier: BSD-3-Clause
#include "judge/SubstrateStatistics.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "fibres/FibreShape.h"
#include "mesh/SurfaceWall.h"
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

/// Memory of a cut and of its row in a table, with room to grow.
constexpr double bytesPerCut = 3.0 * sizeof(FibreCut) + 2.0 * sizeof(ProfilePoint);

/// Returns the index of every surface by fibre id; every surface has to belong to a fibre.
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

/// Returns the mean of the finite values, weighted by the fibres' lengths in the domain; NaN if there are none. By number, thick
/// fibres would count too often in a domain cut from a larger tissue: they reach into it from farther away.
template <typename Value>
double meanOver(const std::vector<FibreStatistics>& fibres, Value&& value)
{
  double sum = 0.0;
  double length = 0.0;
  for (const FibreStatistics& fibre : fibres)
  {
    if (std::isfinite(value(fibre)))
    {
      sum += fibre.length * value(fibre);
      length += fibre.length;
    }
  }
  return length > 0.0 ? sum / length : notANumber;
}

} // namespace

double gRatioOf(double innerVolume, double outerVolume)
{
  return innerVolume > 0.0 && outerVolume > 0.0 ? std::sqrt(innerVolume / outerVolume) : 0.0;
}

double FibreStatistics::gRatioDeviation() const
{
  double count = 0.0;
  double mean = 0.0;
  double squares = 0.0; // of the ways from the mean (Welford 1962)
  for (const ProfilePoint& point : profilesOf({ *this }, 1.0))
  {
    if (!std::isnan(point.gRatio))
    {
      count += 1.0;
      const double way = point.gRatio - mean;
      mean += way / count;
      squares += way * (point.gRatio - mean);
    }
  }
  return count > 0.0 ? std::sqrt(squares / count) : notANumber;
}

double FibreStatistics::axonSurfaceToVolume() const
{
  return this->hasInner && this->inner.volume > 0.0 ? this->innerWallArea / this->inner.volume : notANumber;
}

const PropertyList<SubstrateStatisticsOptions>& SubstrateStatisticsOptions::properties()
{
  using Options = SubstrateStatisticsOptions;
  static const auto list =
    PropertyList<Options>()
      .add("CutSpacing", &Options::cutSpacing, limits::cutSpacing,
        "Distance in µm between two cross-sections along a fibre, 0.01 to 1000.")
      .add("ClipTolerance", &Options::clipTolerance, limits::clipTolerance, "What a surface may reach out of the domain.")
      .use(PropertyUse::Code)
      .include(&Options::walk, ExtraAxonalWalkOptions::properties());
  return list;
}

void SubstrateStatisticsOptions::validate() const
{
  validateProperties(*this);
}

namespace
{

/// The measures of one surface.
struct SurfaceMeasures
{
  SurfaceReport& report;
  RadiusAlongFibre& radius;
  double& wallArea;
  std::vector<FibreCut>& cuts;
};

void measureSurface(const Fibres& fibres, std::size_t fibre, const TriangleMesh& mesh, const std::string& what,
  const SubstrateStatisticsOptions& options, SurfaceMeasures measures)
{
  try
  {
    measures.report = checkSurface(mesh);
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput(what + ": " + error.what());
  }
  requireClipped(mesh, fibres.domain, options.clipTolerance, what);
  measures.cuts = cutsAlongFibre(fibres, fibre, mesh, options.cutSpacing);
  measures.radius = radiusAlongFibre(fibres, fibre, mesh, measures.cuts, measures.report.volume);
  measures.wallArea = areaOf(mesh, wallTriangles(mesh, fibres.domain, largestInset));
}

/// Throws OutOfMemory if the cuts of `sets` surfaces of each fibre do not fit into memory.
void requireRoomForCuts(const Fibres& fibres, std::size_t sets, double spacing)
{
  double cuts = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    cuts += std::min(limits::cuts, lengthInDomain(fibres, f) / spacing);
  }
  requireMemory(
    static_cast<double>(sets) * cuts * bytesPerCut, text("CutSpacing ", spacing, " µm"), "choose a larger CutSpacing");
}

/// Sums over the surfaces of all fibres; fractions of surfaces that are not given are NaN.
void sumUpSurfaces(const Domain& domain, bool hasOuter, bool hasInner, SubstrateStatistics& result)
{
  // Sums in the order of the fibres: the same bits on any number of threads.
  double outerVolume = 0.0;
  double innerVolume = 0.0;
  double bareVolume = 0.0;
  double area = 0.0;
  double outerWall = 0.0;
  double innerWall = 0.0;
  result.smallestAngle = notANumber;
  result.largestSquaredEdgeRatio = notANumber;
  for (const FibreStatistics& fibre : result.fibres)
  {
    outerVolume += fibre.outer.volume;
    innerVolume += fibre.inner.volume;
    bareVolume += fibre.gRatio == 1.0 ? fibre.inner.volume : 0.0;
    area += fibre.outer.area + fibre.inner.area;
    outerWall += fibre.outerWallArea;
    innerWall += fibre.innerWallArea;
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
  result.unmyelinatedFraction = hasBoth ? bareVolume / domainVolume : notANumber;
  result.axonalWaterFraction = hasBoth ? result.axonVolumeFraction / (1.0 - result.myelinVolumeFraction) : notANumber;
  result.aggregateGRatio = !hasBoth ? notANumber
                           : outerVolume > 0.0
                             ? std::sqrt(std::max(0.0, 1.0 - result.myelinVolumeFraction / result.fibreVolumeFraction))
                             : 0.0;
  result.trianglesPerArea = area > 0.0 ? static_cast<double>(result.triangles) / area : notANumber;
  const double outside = domainVolume - outerVolume;
  result.intraSurfaceToVolume = hasInner && innerVolume > 0.0 ? innerWall / innerVolume : notANumber;
  result.extraSurfaceToVolume = hasOuter && outside > 0.0 ? outerWall / outside : notANumber;
}

/// Combines the cuts of all axons. Those of an axon stand for its length in the domain.
void sumUpCuts(SubstrateStatistics& result)
{
  EffectiveRadius all;
  EffectiveRadius middle;
  for (const FibreStatistics& fibre : result.fibres)
  {
    const std::vector<FibreCut>& cuts = fibre.innerCuts;
    for (const FibreCut& cut : cuts)
    {
      all.add(cut.area, fibre.length / static_cast<double>(cuts.size()));
    }
    if (!cuts.empty())
    {
      middle.add(cuts[cuts.size() / 2].area, fibre.length);
    }
    else if (std::isfinite(fibre.innerRadius.mean))
    {
      const double area = pi * fibre.innerRadius.mean * fibre.innerRadius.mean;
      all.add(area, fibre.length);
      middle.add(area, fibre.length);
    }
  }
  result.effectiveRadius = all.value();
  result.middleEffectiveRadius = middle.value();
  result.meanUndulation = meanOver(result.fibres, [](const FibreStatistics& f) { return f.line.undulation; });
  result.meanOuterAxisRatio = meanOver(result.fibres, [](const FibreStatistics& f) { return f.outerRadius.axisRatio; });
  result.meanInnerAxisRatio = meanOver(result.fibres, [](const FibreStatistics& f) { return f.innerRadius.axisRatio; });
  result.meanOuterCalibreVariation = meanOver(result.fibres, [](const FibreStatistics& f) { return f.outerCalibreVariation(); });
  result.meanInnerCalibreVariation = meanOver(result.fibres, [](const FibreStatistics& f) { return f.innerCalibreVariation(); });
  result.meanDiffusivityRatio = meanOver(result.fibres, [](const FibreStatistics& f) { return f.axon.diffusivityRatio; });
  result.meanAreaFluctuation = meanOver(result.fibres, [](const FibreStatistics& f) { return f.axon.areaFluctuation; });
  result.meanBeadAmplitude = meanOver(result.fibres, [](const FibreStatistics& f) { return f.axon.beadAmplitude; });
  result.meanBeadSpacing = meanOver(result.fibres, [](const FibreStatistics& f) { return f.axon.beadSpacing; });
}

} // namespace

SubstrateStatistics measureSubstrate(const Fibres& fibres, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const SubstrateStatisticsOptions& options, const Context& context)
{
  options.validate();
  validate(fibres);
  const auto outerIndex = indexOf(outer, fibres, "Outer");
  const auto innerIndex = indexOf(inner, fibres, "Inner");
  requireRoomForCuts(fibres, (outer.size() > 0 ? 1 : 0) + (inner.size() > 0 ? 1 : 0), options.cutSpacing);

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
                             const std::string& name, SurfaceMeasures measures)
      {
        const auto found = index.find(fibre.fibreId);
        measures.radius = radiusAlong({});
        if (found != index.end())
        {
          const std::string what = "the " + name + " surface of fibre " + std::to_string(fibre.fibreId);
          measureSurface(fibres, f, surfaces.mesh(found->second), what, options, measures);
        }
        return found != index.end();
      };
      fibre.hasOuter =
        measure(outer, outerIndex, "outer", { fibre.outer, fibre.outerRadius, fibre.outerWallArea, fibre.outerCuts });
      fibre.hasInner =
        measure(inner, innerIndex, "inner", { fibre.inner, fibre.innerRadius, fibre.innerWallArea, fibre.innerCuts });
      fibre.axon = axonShape(fibre.innerCuts, options.cutSpacing);
      fibre.line = centreLineShape(fibres, f);
      fibre.gRatio = fibre.hasOuter && fibre.hasInner ? gRatioOf(fibre.inner.volume, fibre.outer.volume) : notANumber;
    },
    "Measuring surfaces");

  sumUpSurfaces(fibres.domain, outer.given(), inner.given(), result);
  sumUpCuts(result);
  if (options.walk.walkers > 0 && outer.size() > 0)
  {
    if (result.outerOpen > 0)
    {
      throw InvalidInput(text("ExtraAxonalWalkers: ", result.outerOpen,
        " of the outer surfaces are not closed and outward, and walkers would leak: set it to 0, or mend them"));
    }
    result.outside = walkOutside(fibres.domain, outer, options.walk, context);
  }
  result.capsuleVolumeFraction = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
  result.largestPenetration = measureOverlap(fibres, 0.0, context.threadCount()).largestPenetration;
  result.meanDispersion = meanDispersion(fibres);
  result.tangentDispersion = meanTangentDispersion(fibres);
  std::vector<AxonSections> axons;
  for (const FibreStatistics& fibre : result.fibres)
  {
    axons.push_back({ &fibre.innerCuts, fibre.innerRadius.mean });
  }
  result.directions = measureDirections(fibres, axons, options.cutSpacing);
  result.meanSinuosity = meanSinuosity(fibres);
  result.meanTargetRadius = meanOver(result.fibres, [](const FibreStatistics& f) { return f.targetRadius; });
  result.meanOuterRadius = meanOver(result.fibres, [](const FibreStatistics& f) { return f.outerRadius.mean; });
  result.meanInnerRadius = meanOver(result.fibres, [](const FibreStatistics& f) { return f.innerRadius.mean; });
  return result;
}

std::vector<ProfilePoint> profilesOf(const std::vector<FibreStatistics>& fibres, double spacing)
{
  std::vector<ProfilePoint> points;
  for (const FibreStatistics& fibre : fibres)
  {
    auto outer = fibre.outerCuts.begin();
    auto inner = fibre.innerCuts.begin();
    while (outer != fibre.outerCuts.end() || inner != fibre.innerCuts.end())
    {
      const bool isOuter = outer != fibre.outerCuts.end() && (inner == fibre.innerCuts.end() || outer->number <= inner->number);
      const bool isInner = inner != fibre.innerCuts.end() && (outer == fibre.outerCuts.end() || inner->number <= outer->number);
      ProfilePoint point;
      point.fibreId = fibre.fibreId;
      point.arcLength = (static_cast<double>(isOuter ? outer->number : inner->number) + 0.5) * spacing;
      point.outerDiameter = isOuter ? 2.0 * equivalentRadius(*outer) : notANumber;
      point.innerDiameter = isInner ? 2.0 * equivalentRadius(*inner) : notANumber;
      point.outerCircularity = isOuter ? outer->circularity : notANumber;
      point.innerCircularity = isInner ? inner->circularity : notANumber;
      point.outerAxisRatio = isOuter ? outer->axisRatio : notANumber;
      point.innerAxisRatio = isInner ? inner->axisRatio : notANumber;
      point.myelinThickness = 0.5 * (point.outerDiameter - point.innerDiameter);
      point.gRatio = point.innerDiameter / point.outerDiameter;
      points.push_back(point);
      outer += isOuter ? 1 : 0;
      inner += isInner ? 1 : 0;
    }
  }
  return points;
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
