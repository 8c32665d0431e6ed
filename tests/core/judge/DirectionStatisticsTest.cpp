// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: directions are measured as their definitions say, on directions that are known.
#include "judge/DirectionStatistics.h"
#include "base/Constants.h"
#include "base/Random.h"
#include "base/SphericalHarmonics.h"
#include "bundle/DirectionDistribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{

using namespace cactus;

/// Straight fibres of 10 µm through these places, in a domain that holds their middle 8 µm.
struct StraightFibres
{
  Fibres fibres;

  StraightFibres()
  {
    this->fibres.domain.lower = { -100.0, -100.0, -4.0 };
    this->fibres.domain.upper = { 100.0, 100.0, 4.0 };
  }
  void add(const Eigen::Vector3d& middle, const Eigen::Vector3d& direction, int bundle = 1)
  {
    const Eigen::Vector3d half = 5.0 * direction.normalized();
    this->fibres.addFibre(static_cast<int>(this->fibres.size()) + 1, bundle, 0.5);
    for (const double along : { -1.0, -0.2, 1.0 })
    {
      this->fibres.addPoint(middle + along * half, 0.5);
    }
  }
  DirectionStatistics measured(
    const std::vector<std::vector<FibreCut>>& cuts = {}, const std::vector<double>& innerRadii = {}) const
  {
    static const std::vector<FibreCut> none;
    std::vector<AxonSections> axons;
    for (std::size_t f = 0; f < this->fibres.size(); ++f)
    {
      axons.push_back({ f < cuts.size() ? &cuts[f] : &none, f < innerRadii.size() ? innerRadii[f] : notANumber });
    }
    return measureDirections(this->fibres, axons, 1.0);
  }
};

Eigen::Vector3d tilted(double angle, double azimuth)
{
  return { std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle) };
}

TEST(DirectionStatistics, ConcentrationIsThatOfWatsonsDistribution)
{
  // Asymptotically ⟨sin²θ⟩ = 1/κ, and ⟨cos²θ⟩ = 1/3 + 4κ/45 for small κ.
  EXPECT_NEAR(watsonConcentration(1.0 - 1e-5), 1e5, 2.0);
  EXPECT_NEAR(watsonConcentration(1.0 / 3.0 + 4.0 * 0.01 / 45.0), 0.01, 1e-4);
  EXPECT_EQ(watsonConcentration(0.3), 0.0);
  EXPECT_NEAR(watsonConcentration(1.0), 1e14, 1e3);
}

TEST(DirectionStatistics, OfDrawnDirectionsAreThoseAskedFor)
{
  const DirectionDistribution watson(DispersionModel::Watson, 15.0);
  RandomEngine engine = randomStream(3, RandomStage::Directions);
  StraightFibres drawn;
  drawn.fibres.domain = Domain::cube(200.0); // whole fibres: a slab would hold longer parts of slanted ones
  for (int i = 0; i < 4000; ++i)
  {
    const double angle = watson.sampleAngle(engine);
    drawn.add({ 180.0 * uniform(engine) - 90.0, 180.0 * uniform(engine) - 90.0, 0.0 }, tilted(angle, 2.0 * pi * uniform(engine)));
  }
  const DirectionStatistics found = drawn.measured();
  // 12.6, with a standard error of κ/√n; ODI is 0.050 at 15°.
  EXPECT_NEAR(found.kappa, watson.parameter(), 0.05 * watson.parameter());
  EXPECT_NEAR(found.odi, 0.050, 0.003);
  EXPECT_NEAR(found.twist, 0.0, 0.04);
  EXPECT_NEAR(found.azimuthRatio, 1.0, 0.1);
  // Angles of two independent directions: their squares add up where angles are small.
  EXPECT_NEAR(found.localSpread, std::sqrt(2.0) * 15.0, 0.8);
}

TEST(DirectionStatistics, ARopeIsTwistedAndAFanIsFlat)
{
  StraightFibres rope;
  StraightFibres fan;
  for (int i = 0; i < 200; ++i)
  {
    const double azimuth = 0.31 * i;
    const double radius = 0.2 * i;
    const Eigen::Vector3d place(radius * std::cos(azimuth), radius * std::sin(azimuth), 0.0);
    const double slope = 0.004 * radius;
    rope.add(place, { -slope * std::sin(azimuth), slope * std::cos(azimuth), 1.0 });
    fan.add(place, { 0.01 * place[0], 0.001 * place[1], 1.0 });
  }
  EXPECT_NEAR(rope.measured().twist, 1.0, 1e-3);
  EXPECT_NEAR(rope.measured().azimuthRatio, 1.0, 0.1);
  EXPECT_NEAR(fan.measured().twist, 0.0, 0.05);
  EXPECT_GT(fan.measured().azimuthRatio, 50.0);
}

TEST(DirectionStatistics, BundlesHaveTheirOwnAxesAndFibresNoSense)
{
  StraightFibres both;
  for (int i = 0; i < 50; ++i)
  {
    both.add({ 3.0 * i - 75.0, 0.0, 0.0 }, { 0.0, 0.0, i % 2 == 0 ? 1.0 : -1.0 });
    both.add({ 3.0 * i - 75.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 }, 2);
  }
  const DirectionStatistics found = both.measured();
  EXPECT_NEAR(found.p2, 1.0, 1e-12);
  EXPECT_NEAR(found.localSpread, 0.0, 1e-9);
  EXPECT_TRUE(std::isnan(found.p2ByAxonVolume)) << "there are no axons";
  EXPECT_TRUE(std::isnan(StraightFibres().measured().p2));
}

TEST(DirectionStatistics, VolumesOfAxonsAreWeights)
{
  StraightFibres fibres;
  std::vector<std::vector<FibreCut>> cuts;
  // Symmetric about z, which is the axis: half of them by 20°, with a share of the volume.
  for (int i = 0; i < 8; ++i)
  {
    const bool isTilted = i % 2 == 0;
    fibres.add({ 20.0 * i - 70.0, 0.0, 0.0 }, tilted(isTilted ? 20.0 * degree : 0.0, 0.25 * pi * i));
    std::vector<FibreCut>& own = cuts.emplace_back();
    for (const std::size_t number : { std::size_t(3), std::size_t(5) }) // the others reach out of the domain, say
    {
      own.push_back({ number, isTilted ? 1.0 : 3.0, 1.0 });
    }
  }
  const double p2 = 0.5 * (3.0 * std::pow(std::cos(20.0 * degree), 2) - 1.0);
  const DirectionStatistics found = fibres.measured(cuts);
  EXPECT_NEAR(found.p2, 0.5 * (p2 + 1.0), 1e-9);
  EXPECT_NEAR(found.p2ByAxonVolume, 0.25 * p2 + 0.75, 1e-9);
  // Without a whole cut, an axon counts with its radius: 8 places of area 1 for each tilted one against 2 of area 3.
  std::vector<double> radii(8, notANumber);
  for (std::size_t f = 0; f < 8; f += 2)
  {
    cuts[f].clear();
    radii[f] = std::sqrt(1.0 / pi);
  }
  EXPECT_NEAR(fibres.measured(cuts, radii).p2ByAxonVolume, (8.0 * p2 + 6.0) / 14.0, 1e-9);
}

TEST(DirectionStatistics, CorrelationWithWhatWasAskedForIsThatOfLegendresPolynomials)
{
  // Asked for: all along z. There are as many places at 20° to it, and of three times the volume.
  StraightFibres fibres;
  fibres.add(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
  fibres.add({ 20.0, 0.0, 0.0 }, tilted(20.0 * degree, 0.4));
  const std::vector<double> radii{ 1.0, std::sqrt(3.0) };
  EXPECT_TRUE(std::isnan(fibres.measured({}, radii).angularCorrelation)) << "nothing was asked for";
  fibres.fibres.orientationHarmonics = harmonicsAt(Eigen::Vector3d::UnitZ(), 4);
  // Σ (2l + 1) P_l(x) for l = 2 and 4 is the product of two directions' harmonics times 4π.
  const auto product = [](double x)
  { return 5.0 * (1.5 * x * x - 0.5) + 9.0 * (35.0 * std::pow(x, 4) - 30.0 * x * x + 3.0) / 8.0; };
  const DirectionStatistics found = fibres.measured({}, radii);
  const double cosine = std::cos(20.0 * degree);
  const double places[] = { 8.0, 3.0 * 8.0 };
  const double same = product(1.0);
  const double other = product(cosine);
  const double expected =
    (places[0] * same + places[1] * other) /
    std::sqrt(same * (places[0] * places[0] * same + 2.0 * places[0] * places[1] * other + places[1] * places[1] * same));
  EXPECT_NEAR(found.angularCorrelation, expected, 1e-9);
  fibres.fibres.orientationHarmonics = { 1.0 }; // all directions alike
  EXPECT_TRUE(std::isnan(fibres.measured({}, radii).angularCorrelation));
}

} // namespace
