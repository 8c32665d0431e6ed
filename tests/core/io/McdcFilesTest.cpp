// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: the simulations that a folder for MC/DC holds run with steps and start boxes that fit the substrate, say how many
// walkers leave it, and let walkers through surfaces as their lists have it.
#include "io/McdcFiles.h"

#include "ExampleSurfaces.h"
#include "ScratchPath.h"
#include "io/SubstrateFolder.h"
#include "judge/ExtraAxonalWalk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

using namespace cactus;
namespace fs = std::filesystem;

namespace
{

using cactus_testing::contentOf;

/// Two straight fibres with axons in a cube of this side, and what is written of them.
class McdcFiles : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Scratch = fs::path(::testing::TempDir()) / ("mcdc-files-test-" + std::to_string(::getpid()));
    fs::remove_all(this->Scratch);
    fs::create_directories(this->Scratch);
    this->makeFibres(20.0);
  }
  void TearDown() override { fs::remove_all(this->Scratch); }

  void makeFibres(double side)
  {
    const double half = 0.5 * side;
    this->Contents.domain = Domain::cube(side);
    this->Contents.outer =
      example::surfacesOf({ 1, 2 }, { example::tube(-1.0, 0.0, 0.6, -half, half), example::tube(1.0, 0.0, 0.8, -half, half) });
    this->Contents.inner = example::surfacesOf(
      { 1, 2 }, { example::tube(-1.0, 0.0, 0.2, 0.1 - half, half - 0.1), example::tube(1.0, 0.0, 0.5, 0.1 - half, half - 0.1) });
  }

  WrittenSubstrate write() { return writeSubstrateFolder(this->Contents, (this->Scratch / "s").string()); }
  std::string text(const std::string& path) const { return contentOf(this->Scratch / "s" / path); }
  /// The words behind a key of a configuration, up to the next line that starts with a letter or a bracket.
  std::vector<std::string> values(const std::string& compartment, const std::string& key) const
  {
    std::istringstream conf(this->text("mcdc/" + compartment + ".conf"));
    std::vector<std::string> found;
    bool isIn = false;
    for (std::string line; std::getline(conf, line);)
    {
      std::istringstream words(line);
      std::string word;
      words >> word;
      const bool isNumber = word.find_first_not_of("-+.e0123456789") == std::string::npos;
      isIn = isNumber ? isIn : word == key;
      if (isIn && isNumber)
      {
        found.push_back(word);
      }
      while (words >> word)
      {
        if (isIn)
        {
          found.push_back(word);
        }
      }
    }
    return found;
  }
  double value(const std::string& compartment, const std::string& key) const
  {
    return std::stod(this->values(compartment, key).at(0));
  }
  /// µm, as MC/DC makes it of what the configuration says.
  double step(const std::string& compartment) const
  {
    return 1e6 * std::sqrt(6.0 * this->value(compartment, "diffusivity") * this->value(compartment, "duration") /
                           this->value(compartment, "T"));
  }
  std::vector<Eigen::Vector3d> starts(const std::string& compartment) const
  {
    std::istringstream lines(this->text("start/" + compartment + ".txt"));
    std::vector<Eigen::Vector3d> points;
    for (Eigen::Vector3d point; lines >> point[0] >> point[1] >> point[2];)
    {
      points.push_back(1e3 * point);
    }
    return points;
  }

  fs::path Scratch;
  SubstrateFolderContents Contents;
};

} // namespace

TEST_F(McdcFiles, StepsFitPoresOutsideAndTheNarrowestAxonInside)
{
  this->write();
  EXPECT_LT(this->step("extra"), 0.05);
  EXPECT_GT(this->step("extra"), 0.0475);
  // 2 V / A of a tube of 0.2 µm with 24 sides: its apothem, 0.198, less the part of its caps.
  EXPECT_LT(this->step("intra"), 0.198);
  EXPECT_GT(this->step("intra"), 0.185);
  for (const char* compartment : { "intra", "extra" })
  {
    // Walls would be missed else: triangles are looked for again when a walker comes to the sphere's surface within a step.
    EXPECT_GT(std::sqrt(this->value(compartment, "T")) * this->value(compartment, "sphere_size"), 2.0);
  }
  this->Contents.inner = example::surfacesOf({ 1 }, { example::tube(1.0, 0.0, 0.02, -9.0, 9.0) });
  this->write();
  EXPECT_NEAR(this->step("intra"), 0.05, 0.0025) << "no finer than outside";
  this->Contents.inner = {};
  this->write();
  EXPECT_LT(this->step("intra"), 0.3) << "of 0.6 µm and more";
  EXPECT_GT(this->step("intra"), 0.285);
}

TEST_F(McdcFiles, WalkersStartAsFarFromTheBoundaryAsTheSampleLetsThem)
{
  this->write();
  // A free walker moves by 11.8 µm. Of 20 µm, a half inside, where axons keep walkers, and a quarter outside.
  EXPECT_EQ(this->values("intra", "<spawning_area>"),
    (std::vector<std::string>{ "-0.005", "-0.005", "-0.005", "0.005", "0.005", "0.005" }));
  EXPECT_EQ(this->values("extra", "<spawning_area>"),
    (std::vector<std::string>{ "-0.0025", "-0.0025", "-0.0025", "0.0025", "0.0025", "0.0025" }));
  EXPECT_EQ(this->values("extra", "ini_walkers_pos"), std::vector<std::string>{ "extra" });
  EXPECT_TRUE(this->values("extra", "ini_walkers_file").empty());
  this->makeFibres(200.0);
  const WrittenSubstrate written = this->write();
  EXPECT_NEAR(this->value("extra", "<spawning_area>"), -0.1 + 4.0 * std::sqrt(2.0 * 2e-9 * 0.035) * 1e3, 1e-8);
  ASSERT_TRUE(written.leaving.has_value());
  EXPECT_EQ(written.leaving->walkers, 0u) << "nobody had to walk";
  EXPECT_LT(written.leaving->share, 0.001);
  EXPECT_NE(this->text("README.txt").find("Fewer than 0.1 % of the walkers of extra.conf leave"), std::string::npos);
}

// One walker for each of the points, which lie in the box that walkers would start in.
TEST_F(McdcFiles, StartPositionsAreWhereWalkersOfTheConfigurationStart)
{
  this->Contents.startPositions = 300;
  this->write();
  for (const auto& [compartment, half] : std::map<std::string, double>{ { "intra", 5.0 }, { "extra", 2.5 } })
  {
    EXPECT_EQ(this->values(compartment, "ini_walkers_file"), std::vector<std::string>{ "start/" + compartment + ".txt" });
    EXPECT_TRUE(this->values(compartment, "ini_walkers_pos").empty() && this->values(compartment, "<spawning_area>").empty());
    EXPECT_EQ(this->value(compartment, "N"), 300.0);
    const auto points = this->starts(compartment);
    ASSERT_EQ(points.size(), 300u);
    double farthest = 0.0;
    for (const Eigen::Vector3d& point : points)
    {
      farthest = std::max(farthest, point.cwiseAbs().maxCoeff());
    }
    EXPECT_LT(farthest, half);
    EXPECT_GT(farthest, 0.95 * half);
  }
  EXPECT_EQ(this->text("README.txt").find("<spawning_area>"), std::string::npos);
  EXPECT_NE(this->text("README.txt").find("MC/DC takes\npoints again from the first"), std::string::npos);
}

TEST_F(McdcFiles, FolderSaysHowManyWalkersLeaveAndWhatWouldDo)
{
  const WrittenSubstrate written = this->write();
  ASSERT_TRUE(written.leaving.has_value());
  // Two thin fibres in 20 µm hardly hold anybody back.
  const Domain start = extraSimulation(this->Contents.mcdc, this->Contents.domain).start;
  const double free = freeLeavingShare(this->Contents.domain, start, this->Contents.mcdc.displacement());
  EXPECT_NEAR(written.leaving->share, free, 0.05);
  EXPECT_GT(free, 0.9);
  ASSERT_EQ(written.remarks.size(), 1u);
  const std::string& remark = written.remarks[0];
  EXPECT_NE(remark.find("of the walkers of mcdc/extra.conf leave the substrate within its 35 ms"), std::string::npos) << remark;
  // What it advises would do: five in a hundred free walkers leave.
  const auto number = [&](const std::string& before) { return std::stod(remark.substr(remark.find(before) + before.size())); };
  McdcOptions shorter = this->Contents.mcdc;
  shorter.echoTime = 1e-3 * number("shorten duration to ");
  EXPECT_NEAR(freeLeavingShare(this->Contents.domain, start, shorter.displacement()), 0.05, 0.02);
  const Domain wider = Domain::cube(number("times as wide ("));
  const Domain widerStart = extraSimulation(this->Contents.mcdc, wider).start;
  EXPECT_NEAR(freeLeavingShare(wider, widerStart, this->Contents.mcdc.displacement()), 0.05, 0.03);
  EXPECT_NEAR(wider.size()[0], 20.0 * number("or make the substrate "), 2.0);

  const std::string readme = this->text("README.txt");
  EXPECT_NE(readme.find(remark), std::string::npos);
  EXPECT_NE(readme.find(" % of the walkers of extra.conf leave the substrate within its 35 ms, by a walk of 200 walkers"),
    std::string::npos)
    << readme;
  EXPECT_NE(this->text("manifest.json").find("\"extra_walkers_leaving\": 0.9"), std::string::npos);

  this->Contents.outer = {};
  EXPECT_FALSE(this->write().leaving.has_value());
  EXPECT_EQ(this->text("manifest.json").find("extra_walkers_leaving"), std::string::npos);
}

// MC/DC takes a permeability of the configuration for all surfaces, whatever the list says, and walkers that cross for its own
// errors unless it is told not to. Walkers that it places inside would meet no other axon's walls.
TEST_F(McdcFiles, PermeabilityIsThatOfEachFile)
{
  this->Contents.mcdc.permeability = 0.02;
  this->Contents.mcdc.walkers = 40;
  this->write();
  for (const char* compartment : { "intra", "extra" })
  {
    const std::string list = std::string("mcdc/") + compartment + "_ply_list.txt";
    EXPECT_TRUE(this->values(compartment, "permeability").empty());
    EXPECT_EQ(this->values(compartment, "deportation"), std::vector<std::string>{ "0" });
    EXPECT_EQ(this->values(compartment, "ply_file_list_scale_permeability"), std::vector<std::string>{ list });
    EXPECT_EQ(
      this->values(compartment, "ini_walkers_file"), std::vector<std::string>{ std::string("start/") + compartment + ".txt" });
    EXPECT_EQ(this->starts(compartment).size(), 40u);
  }
  EXPECT_EQ(this->text("mcdc/intra_ply_list.txt"), "inner/fibre_00001.ply 1e-3 0.02\ninner/fibre_00002.ply 1e-3 0.02\n");
  EXPECT_NE(this->text("README.txt").find("There is neither myelin nor an outer wall in its way"), std::string::npos);
  this->Contents.mcdc.permeability = 0.0;
  this->write();
  EXPECT_TRUE(this->values("intra", "deportation").empty());
  EXPECT_EQ(this->text("README.txt").find("permeable"), std::string::npos);
}

TEST_F(McdcFiles, ProgressDoesNotGoBackForTheWalk)
{
  std::vector<double> fractions;
  Context context;
  context.threads = 1;
  context.progress = [&](double fraction, const std::string&) { fractions.push_back(fraction); };
  writeSubstrateFolder(this->Contents, (this->Scratch / "s").string(), context);
  EXPECT_GT(fractions.size(), 2u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
}
