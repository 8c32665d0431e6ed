// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: all stages describe all of their properties, and start from values that they accept.
#include "stages/Stages.h"

#include "base/Error.h"
#include "stages/StageWork.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace
{

std::string messageFor(const cactus::BundleInitializerStage& wrong)
{
  try
  {
    cactus::bundleOptions(wrong);
  }
  catch (const cactus::InvalidInput& error)
  {
    return error.what();
  }
  return "no error";
}

TEST(Stages, DescribeTheirProperties)
{
  const auto stages = cactus::describeStages();
  EXPECT_EQ(stages.size(), 23u);
  for (const cactus::StageDescription& stage : stages)
  {
    EXPECT_NO_THROW(cactus::validate(stage.properties)) << stage.name;
    std::set<std::string> names;
    for (const auto& [facts, value] : stage.properties)
    {
      const std::string what = stage.name + "." + facts->name;
      EXPECT_TRUE(names.insert(facts->name).second) << what;
      EXPECT_GT(facts->meaning.size(), 8u) << what;
      EXPECT_EQ(facts->meaning.back(), '.') << what;
      EXPECT_NE(facts->use, cactus::PropertyUse::Code) << what;
      const bool isNumber = facts->choices.empty() && value.index() >= 1 && value.index() <= 2;
      EXPECT_EQ(facts->range.has_value(), isNumber) << what;
      if (facts->range)
      {
        EXPECT_LT(facts->range->lowest, facts->range->highest) << what;
      }
    }
    for (const auto& state : stage.properties)
    {
      for (const cactus::PropertyCondition& condition : state.facts->conditions)
      {
        EXPECT_EQ(names.count(condition.property), 1u) << stage.name << "." << state.facts->name;
      }
    }
  }
}

TEST(Stages, DispersionMayBeGivenAsKappaOrIndex)
{
  cactus::BundleInitializerStage stage;
  EXPECT_EQ(cactus::bundleOptions(stage).meanDispersion, 5.0);
  // κ for 5, 10, 15, 20 and 25° as tabled by numerical integration elsewhere, and (2/π) arctan(1/κ).
  const double kappas[] = { 104.0, 26.8, 12.6, 7.8, 5.6 };
  for (int i = 0; i < 5; ++i)
  {
    stage.watsonKappa = kappas[i];
    stage.odi = 0.0;
    EXPECT_NEAR(cactus::bundleOptions(stage).meanDispersion, 5.0 * (i + 1), 0.01 * 5.0 * (i + 1));
    stage.watsonKappa = 0.0;
    stage.odi = 2.0 / 3.14159265358979 * std::atan(1.0 / kappas[i]);
    EXPECT_NEAR(cactus::bundleOptions(stage).meanDispersion, 5.0 * (i + 1), 0.01 * 5.0 * (i + 1));
  }
  stage.watsonKappa = 10.0;
  EXPECT_NE(messageFor(stage).find("both given"), std::string::npos);
  stage.options.dispersionModel = cactus::DispersionModel::Cone; // has neither
  EXPECT_NE(messageFor(stage).find("are for DispersionModel Watson, Coherent and Peaks"), std::string::npos);
  stage.options.dispersionModel = cactus::DispersionModel::Watson;
  stage.odi = 0.0;
  stage.watsonKappa = 1.0;
  EXPECT_NE(messageFor(stage).find("WatsonKappa gives a mean angle of "), std::string::npos);
  stage.watsonKappa = 0.0;
  stage.odi = 1.5;
  EXPECT_EQ(messageFor(stage).find("ODI is 1.5"), 0U);
}

TEST(Stages, HarmonicsAreReadFromText)
{
  cactus::BundleInitializerStage stage;
  stage.options.dispersionModel = cactus::DispersionModel::Harmonics;
  stage.orientationHarmonics = "1, 0;0 0.5\n0\t-1e-3";
  EXPECT_EQ(cactus::bundleOptions(stage).harmonics, (std::vector<double>{ 1.0, 0.0, 0.0, 0.5, 0.0, -1e-3 }));
  stage.orientationHarmonics = "1 two 3";
  EXPECT_THROW(cactus::bundleOptions(stage), cactus::InvalidInput);
  stage.options.dispersionModel = cactus::DispersionModel::Watson;
  EXPECT_TRUE(cactus::bundleOptions(stage).harmonics.empty());
}

TEST(Stages, PeaksAreReadFromText)
{
  cactus::BundleInitializerStage stage;
  stage.options.dispersionModel = cactus::DispersionModel::Peaks;
  stage.orientationPeaks = "0 0 0.5, 1 -2 3";
  const std::vector<Eigen::Vector3d> peaks = cactus::bundleOptions(stage).peaks;
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_EQ(peaks[0], Eigen::Vector3d(0.0, 0.0, 0.5));
  EXPECT_EQ(peaks[1], Eigen::Vector3d(1.0, -2.0, 3.0));
  stage.watsonKappa = 20.0;
  EXPECT_NEAR(cactus::bundleOptions(stage).meanDispersion, cactus::watsonMeanAngle(20.0), 1e-9);
  stage.orientationPeaks = "0 0 0.5 1";
  EXPECT_EQ(messageFor(stage).find("OrientationPeaks has 4 numbers"), 0U);
  stage.orientationPeaks = "0 0 z";
  EXPECT_EQ(messageFor(stage).find("OrientationPeaks holds \"z\""), 0U);
  stage.orientationFile = "fod.nii";
  EXPECT_EQ(messageFor(stage).find("OrientationFile is read by ParaView's filter alone"), 0U);
  stage.options.dispersionModel = cactus::DispersionModel::Watson; // which has no use for it
  EXPECT_EQ(messageFor(stage), "no error");
}

} // namespace
