// SPDX-License-Identifier: BSD-3-Clause
// Fibres whose control points lie much closer together than their radius, as other generators and microscopes give them.
#include "BundleBetweenWalls.h"
#include "bundle/BundleInitializer.h"
#include "fibres/ResampledFibres.h"
#include "optimiser/CapsuleOptimizer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using cactus::Fibres;

constexpr double radius = 0.5; // µm

/// Wavy fibres along z, which overlap somewhat, with beads, and control points `spacing` radii apart.
Fibres wavyBundle(double spacing)
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(8.0);
  for (int column = 0; column < 5; ++column)
  {
    for (int row = 0; row < 5; ++row)
    {
      const int f = 5 * column + row;
      fibres.addFibre(f + 1, 1, radius);
      const auto points = static_cast<int>(std::lround(8.0 / (spacing * radius)));
      for (int i = 0; i <= points; ++i)
      {
        const double z = 8.0 * i / points - 4.0;
        const double phase = 0.9 * z + 2.4 * f;
        const double x = 1.35 * (column - 2) + 0.35 * std::sin(phase);
        const double y = 1.35 * (row - 2) + 0.35 * std::cos(1.1 * phase);
        fibres.addPoint({ x, y, z }, radius * (1.0 + 0.1 * std::sin(2.0 * z + f)));
      }
    }
  }
  return fibres;
}

double lengthOf(const Fibres& fibres)
{
  double length = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f] + 1; i < fibres.offsets[f + 1]; ++i)
    {
      length += (fibres.points[i] - fibres.points[i - 1]).norm();
    }
  }
  return length;
}

double volumeOf(const Fibres& fibres)
{
  double volume = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    volume += cactus::chainVolume(fibres, f);
  }
  return volume;
}

} // namespace

// As they came, they ended 17 % longer, with tangents of 30° instead of 18°, and converged.
TEST(DenseFibres, KeepTheirShapeAsTheyAreParted)
{
  const Fibres given = wavyBundle(0.1);
  Fibres fibres = given;
  const cactus::OptimisationResult result = cactus::optimise(fibres, {}, {});
  EXPECT_EQ(result.reason, cactus::StopReason::Converged);
  EXPECT_EQ(result.resampling.fibres, given.size());
  EXPECT_GT(result.resampling.largestDeviation, 0.0);
  EXPECT_LT(result.resampling.largestDeviation, 0.1 * radius);
  EXPECT_NEAR(lengthOf(fibres) / lengthOf(given), 1.0, 0.03);
  EXPECT_NEAR(result.lengthIncrease, lengthOf(fibres) / lengthOf(given) - 1.0, 1e-12);
  EXPECT_NEAR(cactus::meanTangentDispersion(fibres), cactus::meanTangentDispersion(given), 3.0);
  EXPECT_NEAR(volumeOf(fibres) / volumeOf(given), 1.0, 0.03);
}

TEST(DenseFibres, AreSpacedByTheirRadius)
{
  const Fibres given = wavyBundle(0.1);
  Fibres fibres = given;
  const cactus::Resampling done = cactus::resampleDenseFibres(fibres);
  EXPECT_EQ(done.fibres, given.size());
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const std::size_t last = fibres.offsets[f + 1] - 1;
    EXPECT_EQ(fibres.points[fibres.offsets[f]], given.points[given.offsets[f]]);
    EXPECT_EQ(fibres.points[last], given.points[given.offsets[f + 1] - 1]);
    EXPECT_NEAR(cactus::chainVolume(fibres, f) / cactus::chainVolume(given, f), 1.0, 0.02);
    for (std::size_t i = fibres.offsets[f]; i < last; ++i)
    {
      EXPECT_NEAR((fibres.points[i + 1] - fibres.points[i]).norm(), 0.6 * radius, 0.01);
    }
  }
  EXPECT_EQ(cactus::resampleDenseFibres(fibres).fibres, 0u) << "once is enough";
}

TEST(DenseFibres, OthersKeepTheirBits)
{
  Fibres fibres = wavyBundle(0.6);
  const Fibres given = fibres;
  EXPECT_EQ(cactus::resampleDenseFibres(fibres).fibres, 0u);
  EXPECT_EQ(fibres.points, given.points);
  EXPECT_EQ(fibres.radii, given.radii);

  cactus::BundleBetweenWalls options;
  options.side = 25.0;
  options.fibreVolumeFraction = 0.4;
  options.radius.minimum = 5.0; // with capsules of 2 µm
  options.radius.maximum = 5.0;
  Fibres bundle = cactus::initialiseBundles(options);
  EXPECT_EQ(cactus::resampleDenseFibres(bundle).fibres, 0u);
}

TEST(DenseFibres, ALineThatRunsBackTheWayItCameIsKept)
{
  // Points at equal lengths along it would coincide.
  Fibres fibres;
  fibres.addFibre(1, 1, radius);
  for (int i = 0; i <= 80; ++i)
  {
    fibres.addPoint({ 0.0, 0.0, 0.02 * (i <= 40 ? i : 80 - i) }, radius);
  }
  const Fibres given = fibres;
  EXPECT_EQ(cactus::resampleDenseFibres(fibres).fibres, 0u);
  EXPECT_EQ(fibres.points, given.points);
}
