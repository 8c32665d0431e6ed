// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: published histograms have the means that other papers report for them, and radii are drawn from them.
#include "bundle/RadiusHistogram.h"

#include "base/MyelinThickness.h"
#include "bundle/RadiusDistribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

using namespace cactus;

namespace
{

constexpr std::array<PublishedRadii, 5> callosum = { { PublishedRadii::HumanGenu, PublishedRadii::HumanAnteriorBody,
  PublishedRadii::HumanMidBody, PublishedRadii::HumanPosteriorBody, PublishedRadii::HumanSplenium } };
constexpr std::array<PublishedRadii, 4> areas = { { PublishedRadii::HumanPrefrontal, PublishedRadii::HumanMotor,
  PublishedRadii::HumanParietal, PublishedRadii::HumanVisual } };

/// Returns the fraction of the axons whose diameter is below `diameter`.
double shareBelow(const RadiusHistogram& histogram, double diameter)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < histogram.shares.size(); ++i)
  {
    const double bins = (diameter - histogram.begin) / histogram.width - static_cast<double>(i);
    sum += histogram.shares[i] * std::clamp(bins, 0.0, 1.0);
  }
  return sum / std::accumulate(histogram.shares.begin(), histogram.shares.end(), 0.0);
}

double shareBelow(PublishedRadii which, double diameter)
{
  return shareBelow(radiusHistogram(which), diameter);
}

double medianDiameter(const RadiusHistogram& histogram)
{
  double lower = 0.0;
  double upper = 2.0 * histogram.largestRadius();
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (lower + upper);
    (shareBelow(histogram, middle) < 0.5 ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

/// Returns a distribution that its limits do not truncate.
RadiusDistributionOptions uncut(PublishedRadii which, double gRatio)
{
  RadiusDistributionOptions options;
  options.model = RadiusModel::Histogram;
  options.histogram = which;
  options.histogramGRatio = gRatio;
  options.minimum = 0.001;
  options.maximum = 100.0;
  return options;
}

std::vector<double> draws(const RadiusDistributionOptions& options, int count)
{
  std::vector<double> radii;
  for (int i = 0; i < count; ++i)
  {
    radii.push_back(sampleRadius(options, 11, static_cast<std::uint64_t>(i)));
  }
  return radii;
}

double meanOf(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

TEST(RadiusHistogram, EveryOneIsWhole)
{
  std::set<std::string> names;
  for (const RadiusHistogram& histogram : radiusHistograms())
  {
    EXPECT_TRUE(names.insert(histogram.name).second) << histogram.name;
    EXPECT_NE(histogram.source.find("inner diameter"), std::string::npos) << histogram.name << " says what was measured";
    EXPECT_GT(*std::min_element(histogram.shares.begin(), histogram.shares.end()), -1e-12) << histogram.name;
    EXPECT_GT(histogram.shares.back(), 0.0) << histogram.name << " ends with an empty bin";
    EXPECT_NEAR(shareBelow(histogram, 2.0 * histogram.largestRadius()), 1.0, 1e-12) << histogram.name;
    EXPECT_LT(shareBelow(histogram, 2.0 * histogram.smallestRadius()), 1e-12) << histogram.name;
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(PublishedRadii::MouseGenu) + 1);
  EXPECT_EQ(radiusHistogramNames().size(), names.size());
  for (const PublishedRadii which : callosum)
  {
    const RadiusHistogram& histogram = radiusHistogram(which);
    EXPECT_NE(histogram.name.find("Aboitiz"), std::string::npos);
    EXPECT_NEAR(std::accumulate(histogram.shares.begin(), histogram.shares.end(), 0.0), 100.0, 0.25) << histogram.name;
  }
  for (const PublishedRadii which : areas)
  {
    EXPECT_NE(radiusHistogram(which).name.find("Caminiti"), std::string::npos);
  }
  const std::vector<double>& mouse = radiusHistogram(PublishedRadii::MouseGenu).shares;
  EXPECT_EQ(std::accumulate(mouse.begin(), mouse.end(), 0.0), 227.0); // Lee et al. 2020 count as many axons
}

/// Veraart et al. 2020 (eLife 9:e49855, Figure 7 and its text) compare histograms of human callosa, those of Aboitiz et al. among
/// them: their mean radius is 0.54 to 0.69 µm in all, the effective one 0.91 to 2.9 µm.
TEST(RadiusHistogram, MidBodyHasThePublishedMeanAndEffectiveRadius)
{
  const RadiusHistogram& midBody = radiusHistogram(PublishedRadii::HumanMidBody);
  EXPECT_GE(midBody.meanRadius(), 0.54);
  EXPECT_LE(midBody.meanRadius(), 0.69);
  EXPECT_NEAR(midBody.effectiveRadius(), 2.9, 0.05) << "that with the thickest axons";
}

/// Gamma distributions of the inner radius after Aboitiz et al. 1992: mean and standard deviation (µm) of Γ(2.64, 0.184), Γ(1.34,
/// 0.391), Γ(0.99, 0.723), Γ(1.96, 0.368) and Γ(2.57, 0.232). They rest on one of the three readings of the figure.
TEST(RadiusHistogram, FiveRegionsHaveTheMomentsOfTheirGammaDistributions)
{
  const std::array<std::array<double, 2>, 5> gamma = { { { { 2.64, 0.184 } }, { { 1.34, 0.391 } }, { { 0.99, 0.723 } },
    { { 1.96, 0.368 } }, { { 2.57, 0.232 } } } };
  for (std::size_t i = 0; i < callosum.size(); ++i)
  {
    const RadiusHistogram& histogram = radiusHistogram(callosum[i]);
    const double mean = gamma[i][0] * gamma[i][1];
    EXPECT_NEAR(histogram.meanRadius(), mean, 0.065 * mean) << histogram.name;
    const double deviation = std::sqrt(gamma[i][0]) * gamma[i][1];
    EXPECT_NEAR(histogram.deviation(), deviation, 0.105 * deviation) << histogram.name;
  }
}

/// The paper's abstract: thin fibres are most dense in the genu, decrease backwards along the body and increase again in the
/// splenium; thick ones are where these are rare.
TEST(RadiusHistogram, ThinAndThickAxonsAreWhereThePaperHasThem)
{
  constexpr double thin = 1.0;
  constexpr double thick = 3.1;
  EXPECT_GT(shareBelow(PublishedRadii::HumanGenu, thin), shareBelow(PublishedRadii::HumanMidBody, thin));
  EXPECT_GT(shareBelow(PublishedRadii::HumanMidBody, thin), shareBelow(PublishedRadii::HumanPosteriorBody, thin));
  EXPECT_GT(shareBelow(PublishedRadii::HumanSplenium, thin), shareBelow(PublishedRadii::HumanPosteriorBody, thin));
  for (const PublishedRadii body : { PublishedRadii::HumanMidBody, PublishedRadii::HumanPosteriorBody })
  {
    EXPECT_LT(shareBelow(body, thick), shareBelow(PublishedRadii::HumanGenu, thick));
    EXPECT_LT(shareBelow(body, thick), shareBelow(PublishedRadii::HumanSplenium, thick));
  }
}

/// Caminiti et al. 2009: axons of prefrontal and parietal areas are thinner than those of motor and visual ones (abstract); one
/// in a hundred is thicker than 3 µm (as Veraart et al. 2020 quote it).
TEST(RadiusHistogram, CallosalAxonsOfCorticalAreasAreAsPublished)
{
  double thick = 0.0;
  for (const PublishedRadii which : areas)
  {
    thick += (1.0 - shareBelow(which, 3.0)) / static_cast<double>(areas.size());
  }
  EXPECT_NEAR(thick, 0.01, 0.005);
  for (const PublishedRadii thin : { PublishedRadii::HumanPrefrontal, PublishedRadii::HumanParietal })
  {
    for (const PublishedRadii wide : { PublishedRadii::HumanMotor, PublishedRadii::HumanVisual })
    {
      EXPECT_LT(medianDiameter(radiusHistogram(thin)) + 0.15, medianDiameter(radiusHistogram(wide)));
    }
  }
}

TEST(RadiusHistogram, IsWhatRadiiAreDrawnFrom)
{
  constexpr int count = 40000;
  constexpr double gRatio = 0.6;
  for (const PublishedRadii which : { PublishedRadii::HumanMidBody, PublishedRadii::HumanMotor, PublishedRadii::MouseGenu })
  {
    const RadiusHistogram& histogram = radiusHistogram(which);
    std::vector<double> radii = draws(uncut(which, gRatio), count);
    // Its standard error is the deviation over 200.
    EXPECT_NEAR(gRatio * meanOf(radii), histogram.meanRadius(), 4.0 * histogram.deviation() / 200.0) << histogram.name;
    std::sort(radii.begin(), radii.end());
    EXPECT_GE(gRatio * radii.front(), histogram.smallestRadius());
    EXPECT_LE(gRatio * radii.back(), histogram.largestRadius());
    double worst = 0.0;
    for (std::size_t i = 0; i < radii.size(); ++i)
    {
      const double drawn = (static_cast<double>(i) + 0.5) / count;
      worst = std::max(worst, std::abs(shareBelow(histogram, 2.0 * gRatio * radii[i]) - drawn));
    }
    EXPECT_LT(worst, 1.63 / 200.0) << histogram.name; // the 1 % point of Kolmogorov and Smirnov
  }
}

TEST(RadiusHistogram, IsEnlargedAndCutAsAsked)
{
  RadiusDistributionOptions options = uncut(PublishedRadii::HumanGenu, 1.0);
  const std::vector<double> plain = draws(options, 200);
  options.histogramFactor = 1.25;
  const std::vector<double> swollen = draws(options, 200);
  const std::vector<double> thinner = draws(options.scaled(0.5), 200);
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    EXPECT_DOUBLE_EQ(swollen[i], 1.25 * plain[i]);
    EXPECT_DOUBLE_EQ(thinner[i], 0.5 * swollen[i]);
  }
  options.minimum = 0.4;
  options.maximum = 0.9;
  for (const double radius : draws(options, 200))
  {
    EXPECT_GE(radius, 0.4);
    EXPECT_LE(radius, 0.9);
  }
}

/// With 0 in place of a g-ratio, fibres have the outer diameters that the relation gives for their axons.
TEST(RadiusHistogram, GetsItsMyelinByTheRelationWhereAsked)
{
  RadiusDistributionOptions relation = uncut(PublishedRadii::MouseGenu, 0.0);
  relation.histogramFactor = 1.1;
  RadiusDistributionOptions bare = uncut(PublishedRadii::MouseGenu, 1.0);
  bare.histogramFactor = 1.1;
  const std::vector<double> outer = draws(relation, 100);
  const std::vector<double> inner = draws(bare, 100);
  const std::vector<double> scaled = draws(relation.scaled(2.0), 100);
  for (std::size_t i = 0; i < outer.size(); ++i)
  {
    EXPECT_DOUBLE_EQ(2.0 * outer[i], logLinearOuterDiameter(2.0 * inner[i]));
    EXPECT_DOUBLE_EQ(scaled[i], 2.0 * outer[i]);
    EXPECT_GT(outer[i], inner[i] + 0.3);
  }
}
