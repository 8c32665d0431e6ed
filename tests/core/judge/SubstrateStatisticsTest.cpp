// SPDX-License-Identifier: BSD-3-Clause
#include "judge/SubstrateStatistics.h"

#include "ExampleSurfaces.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Random.h"
#include "base/RandomVariates.h"
#include "fibres/FibreShape.h"
#include "mesh/CrossSection.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

using cactus::pi;
using example::surfacesOf;

/// A closed prism over a regular polygon, along z from -half to half, centred on (x, y).
cactus::TriangleMesh tube(double x, double y, double radius, double half, int sides = 24, int rings = 40)
{
  return example::tube(x, y, radius, -half, half, sides, rings);
}

double polygonFactor(int sides)
{
  return 0.5 * sides * std::sin(2.0 * pi / sides); // area of a regular polygon in the unit circle
}

/// Returns the surface of a fibre along z as the side faces of the domain cut it off: of a convex one, points beyond lie in them.
cactus::TriangleMesh cutToFaces(cactus::TriangleMesh mesh, const cactus::Fibres& fibres)
{
  for (auto& point : mesh.points)
  {
    point.head<2>() = point.head<2>().cwiseMax(fibres.domain.lower.head<2>()).cwiseMin(fibres.domain.upper.head<2>());
  }
  return mesh;
}

/// Two straight fibres along z in a cube of side 10.
cactus::Fibres twoFibres()
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  for (int id : { 3, 5 })
  {
    const double x = id == 3 ? -2.0 : 2.0;
    fibres.addFibre(id, 1, id == 3 ? 1.0 : 1.5);
    for (int i = 0; i <= 12; ++i)
    {
      fibres.addPoint({ x, 0, -6.0 + i }, fibres.targetRadii.back());
    }
  }
  return fibres;
}

} // namespace

TEST(CrossSection, TiltedCutOfATubeIsAnEllipse)
{
  const auto mesh = tube(0, 0, 1.0, 10.0, 360, 200);
  const cactus::CrossSections sections(mesh);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.0, std::sin(0.5), std::cos(0.5));
  for (const double reach : { 1e-3, 1.0, 100.0 })
  {
    const auto outline = sections.outlineAround({ 0.3, -0.2, 1.234 }, normal, reach);
    EXPECT_NEAR(cactus::polygonArea(outline, normal), polygonFactor(360) / std::cos(0.5), 1e-4);
  }
  EXPECT_TRUE(sections.outlineAround({ 1.1, 0, 0 }, normal, 1.0).empty()) << "the point lies outside";
  EXPECT_TRUE(sections.outlineAround({ 0, 0, 11.0 }, Eigen::Vector3d(0, 0, 1), 1.0).empty()) << "the plane misses";
}

// A surface that comes back through the plane counts only around the requested point.
TEST(CrossSection, OnlyTheLoopAroundThePoint)
{
  auto mesh = tube(0, 0, 1.0, 5.0);
  const auto other = tube(4, 0, 2.0, 5.0);
  for (auto t : other.triangles)
  {
    for (auto& point : t)
    {
      point += static_cast<int>(mesh.points.size());
    }
    mesh.triangles.push_back(t);
  }
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  const cactus::CrossSections sections(mesh);
  const Eigen::Vector3d up(0, 0, 1);
  EXPECT_NEAR(cactus::polygonArea(sections.outlineAround({ 0, 0, 0.1 }, up, 1.0), up), polygonFactor(24), 1e-9);
  EXPECT_NEAR(cactus::polygonArea(sections.outlineAround({ 4, 0, 0.1 }, up, 1.0), up), 4.0 * polygonFactor(24), 1e-9);
}

TEST(FibreStatistics, GRatiosDeviateAlongAFibre)
{
  cactus::FibreStatistics fibre;
  EXPECT_TRUE(std::isnan(fibre.gRatioDeviation()));
  for (const std::size_t number : { 0, 1, 2 })
  {
    fibre.outerCuts.push_back({ number, 4.0, 1.0 });
  }
  fibre.innerCuts = { { 0, 0.36 * 4.0, 1.0 }, { 2, 0.64 * 4.0, 1.0 } };
  EXPECT_NEAR(fibre.gRatioDeviation(), 0.1, 1e-12) << "of 0.6 and 0.8";
}

// Guarantee 3: fractions and radii are those of the final meshes.
TEST(SubstrateStatistics, StraightTubes)
{
  const auto fibres = twoFibres();
  const auto outer = surfacesOf({ 3, 5 }, { tube(-2, 0, 1.0, 5.0), tube(2, 0, 1.5, 5.0) });
  const auto inner = surfacesOf({ 3, 5 }, { tube(-2, 0, 0.7, 5.0), tube(2, 0, 0.9, 5.0) });
  const auto result = cactus::measureSubstrate(fibres, outer, inner);
  const double factor = polygonFactor(24);
  EXPECT_NEAR(result.fibreVolumeFraction, 10.0 * factor * (1.0 + 2.25) / 1000.0, 1e-12);
  EXPECT_NEAR(result.axonVolumeFraction, 10.0 * factor * (0.49 + 0.81) / 1000.0, 1e-12);
  EXPECT_NEAR(result.myelinVolumeFraction, result.fibreVolumeFraction - result.axonVolumeFraction, 1e-15);
  EXPECT_NEAR(result.aggregateGRatio, std::sqrt(1.3 / 3.25), 1e-12);
  EXPECT_NEAR(result.capsuleVolumeFraction, 10.0 * pi * 3.25 / 1000.0, 1e-12);
  EXPECT_NEAR(result.meanTargetRadius, 1.25, 1e-15);
  const double equivalent = std::sqrt(factor / pi);
  EXPECT_NEAR(result.meanOuterRadius, 1.25 * equivalent, 1e-9);
  EXPECT_NEAR(result.meanInnerRadius, 0.8 * equivalent, 1e-9);
  EXPECT_NEAR(result.meanDispersion, 0.0, 1e-9);
  EXPECT_EQ(result.outerClosed, 2u);
  EXPECT_EQ(result.innerClosed, 2u);
  EXPECT_EQ(result.outerOpen + result.innerOpen, 0u);
  EXPECT_EQ(result.triangles, 4u * 24u * 82u);
  ASSERT_EQ(result.fibres.size(), 2u);
  const auto& fibre = result.fibres[1];
  EXPECT_EQ(fibre.fibreId, 5);
  EXPECT_NEAR(fibre.length, 10.0, 1e-12);
  EXPECT_NEAR(fibre.gRatio, 0.6, 1e-12);
  // The centre line runs 1 µm out of the domain at both ends; cuts lie at -5.5, -4.5, …, 5.5.
  EXPECT_EQ(fibre.outerRadius.cuts, 10u);
  EXPECT_NEAR(fibre.outerRadius.mean, 1.5 * equivalent, 1e-9);
  EXPECT_NEAR(fibre.outerRadius.deviation, 0.0, 1e-9);
  EXPECT_NEAR(fibre.outerRadius.circularity, (pi / 24.0) / std::tan(pi / 24.0), 1e-9);
}

/// A square prism stretched along x, at any angle to the axes.
TEST(SubstrateStatistics, AxisRatioOfPrisms)
{
  auto fibres = twoFibres();
  fibres.domain = cactus::Domain::cube(40.0);
  for (const double stretch : { 1.0, 1.6, 3.0 })
  {
    for (const double angle : { 0.0, 0.3, 1.2 })
    {
      auto mesh = tube(-2, 0, 1.0, 5.0, 4);
      for (auto& point : mesh.points)
      {
        const double x = stretch * (point.x() + 2.0);
        const double y = point.y();
        point.x() = -2.0 + std::cos(angle) * x - std::sin(angle) * y;
        point.y() = std::sin(angle) * x + std::cos(angle) * y;
      }
      EXPECT_NEAR(cactus::radiusAlong(cactus::cutsAlongFibre(fibres, 0, mesh, 1.0)).axisRatio, 1.0 / stretch, 1e-9);
    }
  }
}

TEST(SubstrateStatistics, CircularityOfPrisms)
{
  const auto fibres = twoFibres();
  for (const int sides : { 4, 6, 200 })
  {
    const double expected = (pi / sides) / std::tan(pi / sides);
    const auto cuts = cactus::cutsAlongFibre(fibres, 0, tube(-2, 0, 1.0, 5.0, sides), 1.0);
    EXPECT_NEAR(cactus::radiusAlong(cuts).circularity, expected, 1e-9);
  }
}

TEST(SubstrateStatistics, RadiusVaryingAlongTheFibre)
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(30.0);
  fibres.addFibre(1, 1, 1.0);
  fibres.addPoint({ 0, 0, -10 }, 1.0);
  fibres.addPoint({ 0, 0, 10 }, 1.0);
  auto mesh = tube(0, 0, 1.0, 10.0, 24, 40);
  for (auto& point : mesh.points)
  {
    point.head<2>() *= 1.0 + 0.02 * point[2];
  }
  const auto radius = cactus::radiusAlong(cactus::cutsAlongFibre(fibres, 0, mesh, 1.0));
  const double equivalent = std::sqrt(polygonFactor(24) / pi);
  EXPECT_EQ(radius.cuts, 20u);
  EXPECT_NEAR(radius.mean, equivalent, 1e-9);
  // 20 values at ±0.5, ±1.5, …, ±9.5: variance (20² - 1) / 12.
  EXPECT_NEAR(radius.deviation, 0.02 * equivalent * std::sqrt(399.0 / 12.0), 1e-9);
}

// Cuts that the domain's boundary truncates do not count.
TEST(SubstrateStatistics, CutsAtTheBoundaryAreLeftOut)
{
  auto fibres = twoFibres();
  fibres.domain.lower[0] = -2.5; // runs through the first tube, whose surface is not clipped here
  const auto mesh = tube(-2, 0, 1.0, 5.0);
  EXPECT_TRUE(cactus::cutsAlongFibre(fibres, 0, mesh, 1.0).empty());
  EXPECT_TRUE(std::isnan(cactus::radiusAlong({}).mean));
  EXPECT_NEAR(cactus::lengthInDomain(fibres, 0), 10.0, 1e-12);
  fibres.domain.lower[0] = 0.0;
  EXPECT_EQ(cactus::lengthInDomain(fibres, 0), 0.0);
}

// A fibre that a face cuts off along its whole length has the radius of its whole tube, and counts by its length.
TEST(SubstrateStatistics, FibresWithoutAWholeCutCountByTheirVolume)
{
  auto fibres = twoFibres();
  fibres.domain.lower[0] = -2.5;
  fibres.domain.upper[0] = 1.0; // the other one's centre line is outside
  const auto outer =
    surfacesOf({ 3, 5 }, { cutToFaces(tube(-2, 0, 1.0, 5.0, 360), fibres), cutToFaces(tube(2, 0, 1.5, 5.0, 360), fibres) });
  const auto inner = surfacesOf({ 3 }, { cutToFaces(example::tube(-2, 0, 0.7, -4.9, 4.9, 360), fibres) });
  const auto result = cactus::measureSubstrate(fibres, outer, inner);
  const auto& half = result.fibres[0];
  EXPECT_EQ(half.outerRadius.cuts + half.innerRadius.cuts, 0u);
  EXPECT_LT(half.outer.volume, 0.85 * 10.0 * pi);
  EXPECT_NEAR(half.outerRadius.mean, 1.0, 0.01);
  EXPECT_NEAR(half.innerRadius.mean, 0.7, 0.01) << "between its caps";
  EXPECT_NEAR(cactus::radiusOfVolume(fibres, 0, tube(-2, 0, 1.0, 5.0, 360), 10.0 * pi), 1.0, 0.01)
    << "of one that is not clipped";
  EXPECT_TRUE(std::isnan(half.outerRadius.deviation) && std::isnan(half.outerCalibreVariation()));
  EXPECT_NEAR(result.fibres[1].outerRadius.mean, 1.5, 0.02);
  EXPECT_EQ(result.fibres[1].length, 0.0);
  EXPECT_EQ(result.meanTargetRadius, 1.0);
  EXPECT_EQ(result.meanOuterRadius, half.outerRadius.mean);
  EXPECT_EQ(result.effectiveRadius, result.middleEffectiveRadius);
  EXPECT_NEAR(result.effectiveRadius, 0.7, 0.01);
}

TEST(SubstrateStatistics, MeansAreOverLengthsOfFibres)
{
  cactus::Fibres fibres = twoFibres();
  fibres.points.resize(fibres.offsets[1] + 7); // fibre 5 ends at z = 0
  fibres.radii.resize(fibres.points.size());
  fibres.offsets[2] = fibres.points.size();
  const auto outer = surfacesOf({ 3, 5 }, { tube(-2, 0, 1.0, 5.0), example::tube(2, 0, 1.4, -5.0, 0.0) });
  const auto result = cactus::measureSubstrate(fibres, outer, {});
  EXPECT_NEAR(result.meanTargetRadius, (2.0 * 1.0 + 1.5) / 3.0, 1e-12);
  EXPECT_NEAR(result.meanOuterRadius, (2.0 * 1.0 + 1.4) / 3.0 * std::sqrt(polygonFactor(24) / pi), 1e-9);
}

// The sample that a box cuts from endless tissue: more thick fibres than thin ones reach into it, and hardly a thick one has a
// whole cross-section there. The mean radius is the tissue's.
TEST(SubstrateStatistics, RadiiOfASampleAreThoseOfItsTissue)
{
  constexpr double side = 8.0;
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(side);
  std::vector<int> ids;
  std::vector<cactus::TriangleMesh> meshes;
  double ofCentres = 0.0;
  double count = 0.0;
  cactus::RandomEngine engine = cactus::randomStream(5, cactus::RandomStage::Directions);
  for (int id = 1; id <= 200; ++id)
  {
    const double radius = id % 2 == 0 ? 0.2 : 1.6;
    const double x = 12.0 * cactus::uniform(engine) - 6.0;
    const double y = 12.0 * cactus::uniform(engine) - 6.0;
    const double away = std::hypot(std::max(0.0, std::abs(x) - 0.5 * side), std::max(0.0, std::abs(y) - 0.5 * side));
    if (away > 0.99 * radius)
    {
      continue;
    }
    fibres.addFibre(id, 1, radius);
    fibres.addPoint({ x, y, -side }, radius);
    fibres.addPoint({ x, y, side }, radius);
    ids.push_back(id);
    meshes.push_back(cutToFaces(example::tube(x, y, radius, -0.5 * side, 0.5 * side, 120, 1), fibres));
    ofCentres += away == 0.0 ? radius : 0.0;
    count += away == 0.0 ? 1.0 : 0.0;
  }
  const auto result = cactus::measureSubstrate(fibres, surfacesOf(ids, meshes), {});
  EXPECT_NEAR(result.meanOuterRadius, result.meanTargetRadius, 0.004 * result.meanTargetRadius);
  EXPECT_NEAR(result.meanTargetRadius, ofCentres / count, 1e-9);
  double byNumber = 0.0;
  double whole = 0.0;
  double wholes = 0.0;
  for (const auto& fibre : result.fibres)
  {
    byNumber += fibre.targetRadius / double(result.fibres.size());
    whole += fibre.outerRadius.cuts > 0 ? fibre.outerRadius.mean : 0.0;
    wholes += fibre.outerRadius.cuts > 0 ? 1.0 : 0.0;
  }
  EXPECT_GT(byNumber, 1.1 * result.meanOuterRadius);
  EXPECT_LT(whole / wholes, 0.9 * result.meanOuterRadius);
}

TEST(SubstrateStatistics, MissingAndOpenSurfaces)
{
  const auto fibres = twoFibres();
  auto open = tube(2, 0, 1.5, 5.0);
  open.triangles.pop_back();
  const auto outer = surfacesOf({ 3, 5 }, { tube(-2, 0, 1.0, 5.0), open });
  const auto inner = surfacesOf({ 5 }, { tube(2, 0, 0.9, 5.0) });
  const auto result = cactus::measureSubstrate(fibres, outer, inner);
  EXPECT_EQ(result.outerClosed, 1u);
  EXPECT_EQ(result.outerOpen, 1u);
  EXPECT_EQ(result.innerClosed, 1u);
  EXPECT_FALSE(result.fibres[0].hasInner);
  EXPECT_TRUE(std::isnan(result.fibres[0].gRatio));
  EXPECT_TRUE(std::isnan(result.fibres[0].innerRadius.mean));
  EXPECT_NEAR(result.meanInnerRadius, 0.9 * std::sqrt(polygonFactor(24) / pi), 1e-9);

  const auto bare = cactus::measureSubstrate(fibres, {}, {});
  EXPECT_TRUE(std::isnan(bare.fibreVolumeFraction) && std::isnan(bare.aggregateGRatio));
  EXPECT_EQ(bare.outerClosed + bare.outerOpen, 0u);
}

TEST(SubstrateStatistics, SaysWhatIsWrong)
{
  const auto fibres = twoFibres();
  const auto messageOf = [&](const cactus::FibreSurfaces& outer, const cactus::SubstrateStatisticsOptions& options)
  {
    try
    {
      cactus::measureSubstrate(fibres, outer, {}, options);
    }
    catch (const cactus::InvalidInput& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(messageOf(surfacesOf({ 3 }, { tube(-2, 0, 1, 5.2) }), {}).find("fibre 3 reaches 0.2"), std::string::npos);
  EXPECT_EQ(messageOf(surfacesOf({ 3 }, { tube(-2, 0, 1, 5.05) }), {}), "");
  EXPECT_NE(messageOf(surfacesOf({ 4 }, { tube(-2, 0, 1, 5) }), {}).find("fibre 4"), std::string::npos);
  cactus::SubstrateStatisticsOptions options;
  options.cutSpacing = 0.0;
  EXPECT_NE(messageOf({}, options).find("CutSpacing"), std::string::npos);
  for (const double spacing :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0, 1e-9, 1e300 })
  {
    options.cutSpacing = spacing;
    EXPECT_NE(messageOf({}, options).find("CutSpacing"), std::string::npos) << spacing;
  }
  // The smallest spacing on a centre line that is far too long for it.
  options.cutSpacing = cactus::limits::cutSpacing.lowest;
  auto winding = twoFibres();
  winding.points.back()[2] += 2.0 * cactus::limits::cutSpacing.lowest * cactus::limits::cuts;
  EXPECT_THROW(cactus::measureSubstrate(winding, surfacesOf({ 5 }, { tube(2, 0, 1, 5) }), {}, options), cactus::InvalidInput);
}

// An empty set of surfaces fills nothing; one that is not given has no fraction.
TEST(SubstrateStatistics, FractionsOverNothing)
{
  cactus::FibreSurfaces empty;
  empty.isGiven = true;
  const auto none = cactus::measureSubstrate(twoFibres(), empty, empty);
  EXPECT_EQ(none.fibreVolumeFraction, 0.0);
  EXPECT_EQ(none.axonVolumeFraction, 0.0);
  EXPECT_EQ(none.myelinVolumeFraction, 0.0);
  EXPECT_EQ(none.aggregateGRatio, 0.0);
  const auto solid = cactus::measureSubstrate(twoFibres(), surfacesOf({ 3 }, { tube(-2, 0, 1, 5) }), empty);
  EXPECT_EQ(solid.axonVolumeFraction, 0.0);
  EXPECT_EQ(solid.myelinVolumeFraction, solid.fibreVolumeFraction);
  EXPECT_EQ(solid.aggregateGRatio, 0.0);
  EXPECT_EQ(cactus::gRatioOf(1.0, 0.0), 0.0);
  EXPECT_EQ(cactus::gRatioOf(-1.0, 2.0), 0.0);
}

TEST(SubstrateStatistics, LargestPenetration)
{
  auto fibres = twoFibres(); // 4 µm apart
  EXPECT_EQ(cactus::measureSubstrate(fibres, {}, {}).largestPenetration, 0.0);
  std::fill(fibres.radii.begin(), fibres.radii.end(), 2.5);
  EXPECT_NEAR(cactus::measureSubstrate(fibres, {}, {}).largestPenetration, 0.2, 1e-12);
}

// Guarantee 4: the same bits on any number of threads.
TEST(SubstrateStatistics, SameOnOneAndThreeThreads)
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(20.0);
  std::vector<int> ids;
  std::vector<cactus::TriangleMesh> meshes;
  for (int id = 1; id <= 9; ++id)
  {
    fibres.addFibre(id, 1, 0.1 * id);
    fibres.addPoint({ 2.0 * id - 10.0, 0.1, -9.0 }, 0.1 * id);
    fibres.addPoint({ 2.0 * id - 10.0, 0.2, 9.0 }, 0.1 * id);
    ids.push_back(id);
    meshes.push_back(tube(2.0 * id - 10.0, 0.15, 0.1 * id, 9.5));
  }
  cactus::Context one;
  one.threads = 1;
  cactus::Context three;
  three.threads = 3;
  const auto a = cactus::measureSubstrate(fibres, surfacesOf(ids, meshes), {}, {}, one);
  const auto b = cactus::measureSubstrate(fibres, surfacesOf(ids, meshes), {}, {}, three);
  EXPECT_EQ(a.fibreVolumeFraction, b.fibreVolumeFraction);
  EXPECT_EQ(a.meanOuterRadius, b.meanOuterRadius);
  EXPECT_EQ(a.trianglesPerArea, b.trianglesPerArea);
  EXPECT_GT(a.meanOuterRadius, 0.4);
}

TEST(SubstrateStatistics, StopsWhenAsked)
{
  cactus::Context context;
  context.threads = 1;
  context.cancelled = [] { return true; };
  EXPECT_THROW(cactus::measureSubstrate(twoFibres(), {}, {}, {}, context), cactus::Cancelled);
}

TEST(SubstrateStatistics, Histogram)
{
  const auto counts =
    cactus::histogram({ 0.0, 0.24, 0.25, 0.99, 1.0, 1.01, -0.1, std::numeric_limits<double>::quiet_NaN() }, 0.0, 1.0, 4);
  EXPECT_EQ(counts, (std::vector<std::size_t>{ 2, 1, 0, 2 }));
  EXPECT_EQ(cactus::histogram({ 0.0, 0.0 }, 0.0, 0.0, 2), (std::vector<std::size_t>{ 0, 2 })); // all values the same
  EXPECT_THROW(cactus::histogram({ 1.0 }, 0.0, 1.0, 0), cactus::InvalidInput);
  EXPECT_THROW(cactus::histogram({ 1.0 }, 0.0, 1.0, 10001), cactus::InvalidInput);
}
