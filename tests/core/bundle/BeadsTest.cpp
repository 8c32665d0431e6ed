// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: beads have the distances, the length and the height asked for; the root mean square of the outer radius is the
// fibre's; a fibre has the same beads however long it is, and one that repeats has them again after its period.
#include "bundle/Beads.h"
#include "base/Error.h"
#include "bundle/VaryingCalibre.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

using namespace cactus;

/// Returns the places of the maxima of b, above the ends of Gaussians, at steps of 0.01 µm.
std::vector<double> maximaOf(const Beads& beads, double half)
{
  std::vector<double> maxima;
  for (double s = -half + 0.01; s < half; s += 0.01)
  {
    if (beads.at(s) > 0.5 && beads.at(s) > beads.at(s - 0.01) && beads.at(s) >= beads.at(s + 0.01))
    {
      maxima.push_back(s);
    }
  }
  return maxima;
}

TEST(Beads, AreAsFarApartAsAsked)
{
  BeadShape shape;
  shape.spacing = 6.0;
  shape.spacingDeviation = 1.5;
  shape.length = 1.0; // so short that each is a maximum
  const double half = 3000.0;
  const std::vector<double> maxima = maximaOf(Beads(shape, 5, 1, half, false), half);
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 1; i < maxima.size(); ++i)
  {
    const double gap = maxima[i] - maxima[i - 1];
    sum += gap;
    squares += gap * gap;
  }
  const double count = double(maxima.size() - 1);
  EXPECT_NEAR(sum / count, 6.0, 4.0 * 1.5 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count - sum * sum / count / count), 1.5, 0.15);
}

TEST(Beads, HaveTheLengthAndTheMoments)
{
  BeadShape shape;
  shape.spacing = 7.0;
  shape.spacingDeviation = 0.0;
  shape.length = 2.0;
  const Beads beads(shape, 1, 1, 100.0, false);
  const double place = maximaOf(beads, 20.0).at(2);
  EXPECT_NEAR(beads.at(place), 1.0, 1e-3);
  EXPECT_NEAR(beads.at(place + 1.0), 0.5, 0.01);
  EXPECT_NEAR(beads.at(place - 1.0), 0.5, 0.01);
  // Means over one distance, by the integrals of a Gaussian and of its square.
  const double width = 1.0 / std::sqrt(2.0 * std::log(2.0));
  EXPECT_NEAR(shape.mean(), width * std::sqrt(2.0 * M_PI) / 7.0, 1e-12);
  EXPECT_NEAR(shape.meanSquare(), width * std::sqrt(M_PI) / 7.0, 2e-3);
}

TEST(Beads, AreAsManyInTheMiddleAsElsewhere)
{
  const BeadShape shape;
  double sum = 0.0;
  constexpr int fibres = 4000;
  for (int fibre = 1; fibre <= fibres; ++fibre)
  {
    sum += Beads(shape, 1, fibre, 1.0, false).at(0.0) / fibres;
  }
  EXPECT_NEAR(sum, shape.mean(), 0.02);
}

TEST(Beads, OfALongerFibreAreTheSameInItsMiddle)
{
  const Beads shorter(BeadShape(), 3, 7, 20.0, false);
  const Beads longer(BeadShape(), 3, 7, 60.0, false);
  const Beads another(BeadShape(), 3, 8, 20.0, false);
  double difference = 0.0;
  for (double s = -20.0; s <= 20.0; s += 0.37)
  {
    EXPECT_NEAR(shorter.at(s), longer.at(s), 1e-6);
    difference = std::max(difference, std::abs(shorter.at(s) - another.at(s)));
  }
  EXPECT_GT(difference, 0.3);
}

TEST(Beads, RepeatAfterThePeriod)
{
  BeadShape shape;
  shape.spacingDeviation = 0.5; // so that no two become one
  const Beads beads(shape, 3, 7, 9.0, true);
  double most = 0.0;
  for (double s = -9.0; s <= 0.0; s += 0.1)
  {
    EXPECT_NEAR(beads.at(s), beads.at(s + 18.0), 1e-6);
    most = std::max(most, beads.at(s));
  }
  EXPECT_GT(most, 0.9);
  EXPECT_EQ(maximaOf(beads, 9.0).size(), 4U); // 18 µm hold 3.5 of 5.1 µm
}

TEST(Beads, GiveFibresTheirAmplitudeAndKeepTheirMeanSquare)
{
  BundleInitializerOptions options;
  options.radius.minimum = options.radius.maximum = 0.9;
  options.grownFibreVolumeFraction = 0.0;
  options.calibre.model = CalibreModel::Beads;
  options.calibre.beadAmplitude = 0.5;
  Fibres fibres;
  fibres.domain = Domain::cube(100.0);
  for (int f = 0; f < 40; ++f)
  {
    fibres.addFibre(f + 1, 1, 0.9);
    for (int k = -500; k <= 500; ++k)
    {
      fibres.addPoint({ 10.0 * f, 0.0, 0.1 * k }, 0.9);
    }
  }
  varyCalibre(options, fibres);
  double squares = 0.0;
  for (const double r : fibres.radii)
  {
    squares += r * r / double(fibres.radii.size());
  }
  EXPECT_NEAR(std::sqrt(squares), 0.9, 0.01 * 0.9);

  // The myelin is as thick everywhere: 0.3 of the radius of a pipe of the mean axon.
  options.calibre.beads.spacingDeviation = 0.0;
  for (double& r : fibres.radii)
  {
    r = 0.9;
  }
  varyCalibre(options, fibres);
  double mean = 0.0;
  for (const double r : fibres.radii)
  {
    mean += r / double(fibres.radii.size());
  }
  const double myelin = 0.3 * mean;
  const double largest = *std::max_element(fibres.radii.begin(), fibres.radii.end());
  EXPECT_NEAR((largest - myelin) / (mean - myelin) - 1.0, 0.5, 0.02);
}

TEST(Beads, ThatRunIntoEachOtherAreRefused)
{
  BundleInitializerOptions options;
  options.calibre.model = CalibreModel::Beads;
  EXPECT_NO_THROW(options.validate());
  options.calibre.beads.spacing = 3.0;
  EXPECT_THROW(options.validate(), InvalidInput);
}

} // namespace
