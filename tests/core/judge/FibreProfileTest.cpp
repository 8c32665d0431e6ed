// SPDX-License-Identifier: BSD-3-Clause
// Shapes whose measures are known in closed form.
#include "judge/FibreProfile.h"

#include "ExampleSurfaces.h"
#include "base/Constants.h"
#include "judge/SubstrateStatistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

using cactus::pi;
using example::surfacesOf;

constexpr int sides = 24;
constexpr double length = 20.0;

/// Area of the cross-section of example::tube() of radius 1.
double sectionOfOne()
{
  return 0.5 * sides * std::sin(2.0 * pi / sides);
}

/// One straight fibre along z in the middle of a cube that its ends do not reach.
cactus::Fibres straightFibre(double side = 30.0)
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(side);
  fibres.addFibre(7, 1, 1.0);
  fibres.addPoint({ 0, 0, -0.5 * length }, 1.0);
  fibres.addPoint({ 0, 0, 0.5 * length }, 1.0);
  return fibres;
}

/// Makes a tube around it, with radius radius·(1 + part·cos(2π·waves·z / length)); rings lie at the cuts.
cactus::TriangleMesh wavyTube(double radius, double part, int waves)
{
  auto mesh = example::tube(0, 0, radius, -0.5 * length, 0.5 * length, sides, 400);
  for (auto& point : mesh.points)
  {
    point.head<2>() *= 1.0 + part * std::cos(2.0 * pi * waves * point[2] / length);
  }
  return mesh;
}

/// The shape of one fibre along these points, in a cube of this side.
cactus::CentreLineShape lineShape(const std::vector<Eigen::Vector3d>& points, double side)
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(side);
  fibres.addFibre(1, 1, 1.0);
  for (const auto& point : points)
  {
    fibres.addPoint(point, 1.0);
  }
  return cactus::centreLineShape(fibres, 0);
}

TEST(AxonShape, TellsBeads)
{
  // Radius 1, and three beads of 1.5 at the cuts 20, 60 and 80, two cuts wide on either side.
  std::vector<cactus::FibreCut> cuts;
  double sum = 0.0;
  for (std::size_t i = 0; i < 100; ++i)
  {
    const std::size_t distance = std::min({ i > 20 ? i - 20 : 20 - i, i > 60 ? i - 60 : 60 - i, i > 80 ? i - 80 : 80 - i });
    const double radius = distance == 0 ? 1.5 : distance <= 2 ? 1.3 : 1.0;
    cuts.push_back({ i, cactus::pi * radius * radius, 1.0 });
    sum += radius;
  }
  const auto shape = cactus::axonShape(cuts, 0.25);
  EXPECT_NEAR(shape.beadAmplitude, 1.5 / (sum / 100.0) - 1.0, 1e-12);
  EXPECT_NEAR(shape.beadSpacing, 0.25 * 30.0, 1e-12);

  const auto pipe = cactus::axonShape({ { 0, 2.0, 1.0 }, { 1, 2.0, 1.0 }, { 2, 2.0, 1.0 } }, 0.25);
  EXPECT_TRUE(std::isnan(pipe.beadAmplitude) && std::isnan(pipe.beadSpacing));
}

} // namespace

TEST(AxonShape, OfAStraightTube)
{
  const auto shape = cactus::axonShape(cactus::cutsAlongFibre(straightFibre(), 0, wavyTube(0.8, 0.0, 0), 1.0), 1.0);
  const double area = 0.64 * sectionOfOne();
  EXPECT_NEAR(shape.meanInverseArea, 1.0 / area, 1e-9);
  EXPECT_NEAR(shape.areaVariance, 0.0, 1e-15);
  EXPECT_NEAR(shape.areaFluctuation, 0.0, 1e-15);
  EXPECT_NEAR(shape.diffusivityRatio, 1.0, 1e-12);
  EXPECT_NEAR(shape.effectiveRadius, std::sqrt(area / pi), 1e-9);
}

// Inner surfaces end a little before the domain's faces: cuts truncated by their caps do not count, like those truncated by the
// faces.
TEST(FibreProfile, LeavesOutCutsOfCapsBeforeTheFaces)
{
  constexpr double slope = 0.5;
  constexpr double inset = 0.02;
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(length);
  fibres.addFibre(7, 1, 1.0);
  fibres.addPoint({ -0.5 * slope * length, 0, -0.5 * length }, 1.0);
  fibres.addPoint({ 0.5 * slope * length, 0, 0.5 * length }, 1.0);
  auto mesh = example::tube(0, 0, 0.8, -0.5 * length + inset, 0.5 * length - inset, sides, 400);
  for (auto& point : mesh.points)
  {
    point[0] += slope * point[2];
  }
  const auto cuts = cactus::cutsAlongFibre(fibres, 0, mesh, 0.1);
  const double middle = cuts[cuts.size() / 2].area;
  for (const auto& cut : cuts)
  {
    EXPECT_NEAR(cut.area, middle, 1e-3 * middle) << cut.number;
  }
  // Caps cut off some 0.4 µm at each end, no more.
  EXPECT_GT(cuts.size(), 210u);
  EXPECT_LT(cuts.size(), 220u);
}

// A side of a surface as near to a face as a cap would be does not count as a cap.
TEST(FibreProfile, KeepsCutsBesideAFace)
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(length + 0.04);
  fibres.addFibre(7, 1, 1.0);
  fibres.addPoint({ 0.5 * length - 0.8, 0, -0.5 * length }, 1.0);
  fibres.addPoint({ 0.5 * length - 0.8, 0, 0.5 * length }, 1.0);
  const auto mesh = example::tube(0.5 * length - 0.8, 0, 0.8, -0.5 * length, 0.5 * length, sides, 400);
  EXPECT_EQ(cactus::cutsAlongFibre(fibres, 0, mesh, 1.0).size(), 20u);
}

// Means over whole waves of r = R (1 + e cos x): for 1/r² (1 - e²)^(-3/2) / R², for powers of r by the binomial theorem.
TEST(AxonShape, OfARadiusThatVariesAsACosine)
{
  const double e = 0.3;
  const double square = 1.0 + e * e / 2.0;
  const double fourth = 1.0 + 3.0 * e * e + 3.0 / 8.0 * std::pow(e, 4);
  const double sixth = 1.0 + 15.0 / 2.0 * e * e + 45.0 / 8.0 * std::pow(e, 4) + 5.0 / 16.0 * std::pow(e, 6);
  const double inverse = std::pow(1.0 - e * e, -1.5);
  const double area = 0.64 * sectionOfOne();
  for (const int waves : { 1, 2 })
  {
    const auto cuts = cactus::cutsAlongFibre(straightFibre(), 0, wavyTube(0.8, e, waves), 0.5);
    ASSERT_EQ(cuts.size(), 40u);
    const auto shape = cactus::axonShape(cuts, 0.5);
    EXPECT_NEAR(shape.meanInverseArea, inverse / area, 1e-6);
    EXPECT_NEAR(shape.areaVariance, fourth / (square * square) - 1.0, 1e-6);
    EXPECT_NEAR(shape.diffusivityRatio, 1.0 / (square * inverse), 1e-6);
    EXPECT_NEAR(shape.effectiveRadius, std::pow(sixth / square, 0.25) * std::sqrt(area / pi), 1e-6);
    // A / ⟨A⟩ has the amplitude 2e / (1 + e²/2) at the wave number of the waves; the longest wave has it only for a single wave.
    const double amplitude = waves == 1 ? 2.0 * e / square : 0.0;
    EXPECT_NEAR(shape.areaFluctuation, amplitude * amplitude * length / 4.0, 1e-6);
    const auto radius = cactus::radiusAlong(cuts);
    EXPECT_NEAR(radius.deviation / radius.mean, e / std::sqrt(2.0), 1e-6);
  }
}

TEST(AxonShape, NeedsCuts)
{
  const auto none = cactus::axonShape({}, 1.0);
  EXPECT_TRUE(std::isnan(none.meanInverseArea) && std::isnan(none.areaFluctuation) && std::isnan(none.effectiveRadius));
  const auto two = cactus::axonShape({ { 0, 1.0, 1.0, 1.0 }, { 1, 3.0, 1.0, 1.0 } }, 1.0);
  EXPECT_TRUE(std::isnan(two.areaFluctuation));
  EXPECT_NEAR(two.meanInverseArea, 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(two.areaVariance, 0.25, 1e-15);
}

TEST(CentreLineShape, OfAHelixAndOfBends)
{
  const double radius = 2.0;
  const double pitch = 5.0;
  std::vector<Eigen::Vector3d> helix;
  for (int i = 0; i <= 30000; ++i)
  {
    const double turn = i / 10000.0;
    helix.emplace_back(radius * std::cos(2.0 * pi * turn), radius * std::sin(2.0 * pi * turn), pitch * (turn - 1.5));
  }
  EXPECT_NEAR(lineShape(helix, 40.0).sinuosity, std::hypot(2.0 * pi * radius, pitch) / pitch, 1e-6);
  // Its ends lie at the same angle: the straight line through them is on the cylinder, at a mean square distance of 2 radius².
  EXPECT_NEAR(lineShape(helix, 40.0).undulation, std::sqrt(2.0) * radius, 1e-6);
  EXPECT_EQ(lineShape({ { 0, 0, -3 }, { 0, 0, 1 }, { 0, 0, 4 } }, 10.0).sinuosity, 1.0);
  EXPECT_NEAR(lineShape({ { 0, 0, -3 }, { 0, 0, 1 }, { 0, 0, 4 } }, 10.0).undulation, 0.0, 1e-12);
  // A triangle of height 3, continued straight outside.
  EXPECT_NEAR(
    lineShape({ { 0, 0, -9 }, { 0, 0, -5 }, { 0, 3, 0 }, { 0, 0, 5 }, { 0, 0, 9 } }, 10.0).undulation, std::sqrt(3.0), 1e-12);
  // Legs of 3 and 7 µm are in the domain; the line continues outside.
  EXPECT_NEAR(lineShape({ { 2, 1, -9 }, { 2, 1, -2 }, { -9, 1, -2 } }, 10.0).sinuosity, 10.0 / std::sqrt(58.0), 1e-12);
  // It leaves the domain (through x = 5) and comes back: the part in between counts.
  EXPECT_NEAR(lineShape({ { 4, 0, -3 }, { 8, 0, -3 }, { 8, 0, 3 }, { 4, 0, 3 } }, 10.0).sinuosity, 14.0 / 6.0, 1e-12);
  EXPECT_TRUE(std::isnan(lineShape({ { 8, 0, 0 }, { 9, 0, 0 } }, 10.0).sinuosity));
  EXPECT_TRUE(std::isnan(lineShape({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 0 } }, 10.0).sinuosity));
}

// Caps are no walls: neither those in the domain's faces, nor those of axons a little before them.
TEST(SubstrateStatistics, SurfaceToVolumeWithoutCaps)
{
  cactus::Fibres fibres = straightFibre(length);
  fibres.addFibre(9, 1, 1.0);
  fibres.addPoint({ 5, 0, -0.5 * length }, 1.0);
  fibres.addPoint({ 5, 0, 0.5 * length }, 1.0);
  const auto tube = [](double x, double radius, double inset)
  { return example::tube(x, 0, radius, -0.5 * length + inset, 0.5 * length - inset, sides); };
  const auto outer = surfacesOf({ 7, 9 }, { tube(0, 1.0, 0.0), tube(5, 2.0, 0.0) });
  const auto inner = surfacesOf({ 7, 9 }, { tube(0, 0.5, 0.02), tube(5, 1.0, 0.1) });
  const auto result = cactus::measureSubstrate(fibres, outer, inner);
  const double perimeter = 2.0 * sides * std::sin(pi / sides); // of radius 1
  EXPECT_NEAR(result.fibres[0].axonSurfaceToVolume(), perimeter / sectionOfOne() / 0.5, 1e-9);
  EXPECT_NEAR(result.fibres[1].axonSurfaceToVolume(), perimeter / sectionOfOne(), 1e-9);
  EXPECT_NEAR(result.fibres[0].axonSurfaceToVolume(), 2.0 / 0.5, 0.04) << "of a circle";
  const double axons = 0.5 * (length - 0.04) + length - 0.2;
  const double axonVolume = 0.25 * (length - 0.04) + length - 0.2;
  EXPECT_NEAR(result.intraSurfaceToVolume, perimeter * axons / (sectionOfOne() * axonVolume), 1e-9);
  EXPECT_NEAR(
    result.extraSurfaceToVolume, 3.0 * perimeter * length / (length * length * length - 5.0 * sectionOfOne() * length), 1e-9);
  const double sixth = (std::pow(0.5, 6) + 1.0) / (0.25 + 1.0);
  EXPECT_NEAR(result.effectiveRadius, std::pow(sixth, 0.25) * std::sqrt(sectionOfOne() / pi), 1e-9);
  EXPECT_NEAR(result.middleEffectiveRadius, result.effectiveRadius, 1e-9);
  EXPECT_NEAR(result.meanSinuosity, 1.0, 1e-12);

  const auto bare = cactus::measureSubstrate(fibres, outer, {});
  EXPECT_TRUE(std::isnan(bare.intraSurfaceToVolume) && std::isnan(bare.effectiveRadius));
  EXPECT_TRUE(std::isnan(bare.fibres[0].axonSurfaceToVolume()));
  EXPECT_EQ(bare.extraSurfaceToVolume, result.extraSurfaceToVolume);
}

// The middle cut of each axon counts once, however many cuts the axon has and whatever its other cuts are.
TEST(SubstrateStatistics, EffectiveRadiusOfAllCutsAndOfTheMiddleOnes)
{
  cactus::Fibres fibres = straightFibre();
  const auto inner = surfacesOf({ 7 }, { wavyTube(0.8, 0.3, 1) });
  const auto result = cactus::measureSubstrate(fibres, {}, inner);
  EXPECT_NEAR(result.effectiveRadius, result.fibres[0].axon.effectiveRadius, 1e-12);
  const double atHalf = 0.8 * (1.0 + 0.3 * std::cos(2.0 * pi * 0.5 / length)); // with 20 cuts, it lies half a µm from the middle
  EXPECT_NEAR(result.middleEffectiveRadius, atHalf * std::sqrt(sectionOfOne() / pi), 1e-9);
}

TEST(Profiles, RowsOfBothSurfaces)
{
  cactus::Fibres fibres = straightFibre();
  const auto outer = surfacesOf({ 7 }, { wavyTube(1.0, 0.2, 1) });
  // The axon ends in the middle of the fibre.
  const auto inner = surfacesOf({ 7 }, { example::tube(0, 0, 0.5, -0.5 * length, 0.2, sides) });
  const auto result = cactus::measureSubstrate(fibres, outer, inner);
  const auto points = cactus::profilesOf(result.fibres, 1.0);
  ASSERT_EQ(points.size(), 20u);
  const double equivalent = std::sqrt(sectionOfOne() / pi);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto& point = points[i];
    const double s = double(i) + 0.5;
    EXPECT_EQ(point.fibreId, 7);
    EXPECT_NEAR(point.arcLength, s, 1e-12);
    const double diameter = 2.0 * equivalent * (1.0 + 0.2 * std::cos(2.0 * pi * (s - 10.0) / length));
    EXPECT_NEAR(point.outerDiameter, diameter, 1e-9);
    EXPECT_NEAR(point.outerCircularity, (pi / sides) / std::tan(pi / sides), 1e-9);
    EXPECT_EQ(std::isnan(point.innerDiameter), i >= 10);
    EXPECT_EQ(std::isnan(point.gRatio) && std::isnan(point.myelinThickness) && std::isnan(point.innerCircularity), i >= 10);
    if (i < 10)
    {
      EXPECT_NEAR(point.innerDiameter, equivalent, 1e-9);
      EXPECT_NEAR(point.myelinThickness, 0.5 * (diameter - equivalent), 1e-9);
      EXPECT_NEAR(point.gRatio, equivalent / diameter, 1e-9);
    }
  }
  EXPECT_TRUE(cactus::profilesOf(cactus::measureSubstrate(fibres, {}, {}).fibres, 1.0).empty());
}
