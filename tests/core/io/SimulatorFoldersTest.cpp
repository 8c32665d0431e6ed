// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a folder for a simulator gives the right signal as its README.txt has it run, or says that it does not.
#include "io/SubstrateFolder.h"

#include "ExampleSurfaces.h"
#include "ScratchPath.h"
#include "base/Error.h"
#include "base/JsonText.h"
#include "mesh/SurfaceCheck.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

namespace
{

using cactus_testing::contentOf;
using example::surfacesOf;

class SimulatorFolders : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Scratch = fs::path(::testing::TempDir()) / ("simulator-folders-test-" + std::to_string(::getpid()));
    fs::remove_all(this->Scratch);
    fs::create_directories(this->Scratch);
    this->Contents.domain = cactus::Domain::cube(10.0);
  }
  void TearDown() override { fs::remove_all(this->Scratch); }

  /// Two plates across the domain, this far (µm) from each other and from the faces below and above, with an axon in each.
  void takePlates(double gap, double fromFaces)
  {
    const double low = -5.0 + fromFaces;
    const double in = 0.5 * gap;
    this->Contents.outer =
      surfacesOf({ 1, 2 }, { example::box({ -5, -5, low }, { 5, 5, -in }), example::box({ -5, -5, in }, { 5, 5, -low }) });
    this->Contents.inner = surfacesOf(
      { 1, 2 }, { example::box({ -4, -4, low + 1 }, { 4, 4, -in - 1 }), example::box({ -4, -4, in + 1 }, { 4, 4, -low - 1 }) });
  }
  cactus::WrittenSubstrate write(cactus::SubstrateFormat format)
  {
    this->Contents.format = format;
    return cactus::writeSubstrateFolder(this->Contents, (this->Scratch / "s").string());
  }
  std::string readme() const { return contentOf(this->Scratch / "s/README.txt"); }

  fs::path Scratch;
  cactus::SubstrateFolderContents Contents;
};

} // namespace

// Camino ends with 0 and no signal without -voxels, and with "has crossed" where repeats touch. Water between repeats is free, so
// they are as near to each other as Camino takes.
TEST_F(SimulatorFolders, CaminoHasTheCommandsOfThisSubstrate)
{
  this->takePlates(1.0, 0.5);
  this->Contents.domain.upper[2] += 2.0;
  EXPECT_TRUE(this->write(cactus::SubstrateFormat::Camino).remarks.empty());
  const std::string text = this->readme();
  for (const auto& [where, kind] : { std::pair<const char*, const char*>{ "intra", "inner" }, { "extra", "outer" } })
  {
    const std::size_t begin = text.find(std::string("-voxels 1 -initial ") + where + " ");
    ASSERT_NE(begin, std::string::npos) << where;
    const std::string command = text.substr(begin, text.find(".bfloat", begin) - begin);
    EXPECT_NE(command.find(std::string("-plyfile ") + kind + ".ply"), std::string::npos) << command;
    EXPECT_NE(command.find("-meshsep 1.0001e-05 1.0001e-05 1.2001e-05 "), std::string::npos) << command;
    EXPECT_NE(command.find("-schemefile pgse.scheme "), std::string::npos) << command;
  }
  EXPECT_EQ(contentOf(this->Scratch / "s/pgse.scheme"), cactus::mcdcScheme(this->Contents.mcdc));
}

// RMS's walkers cross faces of voxels only: a label in pieces is a wrong signal without a word.
TEST_F(SimulatorFolders, RmsHasNoLabelOutsideThatFallsApart)
{
  this->Contents.voxelSize = 0.5;
  this->takePlates(1.0, 1.0); // three layers outside, of as much each
  const auto written = this->write(cactus::SubstrateFormat::Rms);
  ASSERT_EQ(written.remarks.size(), 1u);
  EXPECT_NE(written.remarks[0].find("voxels outside fall into 3 pieces, 33.3 % of them connected, and fill 0.3 of the domain, "
                                    "where the surfaces have 0.3: grow with a MinimumGap of 0.5 µm or more, or choose a "
                                    "VoxelSize no larger than the smallest gap, 1 µm"),
    std::string::npos)
    << written.remarks[0];
  EXPECT_FALSE(fs::exists(this->Scratch / "s/extra"));
  EXPECT_TRUE(fs::exists(this->Scratch / "s/intra/fiber.txt"));
  EXPECT_NE(this->readme().find(written.remarks[0]), std::string::npos);
  EXPECT_NE(this->readme().find("voxels inside the 2 axons fall into 2 pieces, 100 % of them connected"), std::string::npos);
}

TEST_F(SimulatorFolders, RmsHasNoLabelOutsideThatLostItsVolume)
{
  this->Contents.voxelSize = 1.0;
  this->takePlates(0.8, 0.0); // no voxel of the gap is mostly outside
  EXPECT_NE(this->write(cactus::SubstrateFormat::Rms).remarks.at(0).find("fill 0 of the domain, where the surfaces have 0.08"),
    std::string::npos);
  EXPECT_FALSE(fs::exists(this->Scratch / "s/extra"));
  this->Contents.voxelSize = 0.2; // it is, of four layers
  EXPECT_TRUE(this->write(cactus::SubstrateFormat::Rms).remarks.empty());
  EXPECT_TRUE(fs::exists(this->Scratch / "s/extra/fiber.txt"));
  EXPECT_NE(this->readme().find("voxels outside fall into 1 pieces, 100 % of them connected, and fill 0.08 of the domain"),
    std::string::npos);
}

// All that is outside holds together around the fibres, and the gap between them is lost.
TEST_F(SimulatorFolders, RmsWarnsOfGapsNarrowerThanAVoxel)
{
  this->Contents.voxelSize = 0.5;
  for (const double gap : { 0.2, 1.0 })
  {
    const double in = 0.5 * gap;
    this->Contents.outer =
      surfacesOf({ 1, 2 }, { example::box({ -2, -2, -4 }, { 2, 2, -in }), example::box({ -2, -2, in }, { 2, 2, 4 }) });
    this->Contents.inner =
      surfacesOf({ 1, 2 }, { example::box({ -1, -1, -3 }, { 1, 1, -1 }), example::box({ -1, -1, 1 }, { 1, 1, 3 }) });
    const auto remarks = this->write(cactus::SubstrateFormat::Rms).remarks;
    EXPECT_TRUE(fs::exists(this->Scratch / "s/extra"));
    ASSERT_EQ(remarks.size(), gap < 0.5 ? 1u : 0u);
    if (gap < 0.5)
    {
      EXPECT_NE(remarks[0].find("2 of 2 fibres come nearer to another one than a voxel, 0.5 µm"), std::string::npos)
        << remarks[0];
    }
  }
}

TEST_F(SimulatorFolders, RmsRefusesAxonsThatFallApart)
{
  this->Contents.voxelSize = 0.5;
  this->takePlates(1.0, 0.5);
  // Two rooms of one axon, as if the neck between them were thinner than a voxel.
  const auto rooms = example::both(example::box({ -4, -4, -4 }, { -1, 4, -1.5 }), example::box({ 1, -4, -4 }, { 4, 4, -1.5 }));
  this->Contents.inner = surfacesOf({ 1 }, { rooms });
  try
  {
    this->write(cactus::SubstrateFormat::Rms);
    FAIL() << "is written";
  }
  catch (const cactus::InvalidInput& error)
  {
    EXPECT_NE(
      std::string(error.what()).find("voxels inside the 1 axons fall into 2 pieces, 50 % of them connected"), std::string::npos)
      << error.what();
  }
}

TEST_F(SimulatorFolders, SpinDoctorWarnsOfGapsThatAreNarrowForTetgen)
{
  this->takePlates(0.05, 0.5);
  const auto narrow = this->write(cactus::SubstrateFormat::SpinDoctor).remarks;
  ASSERT_FALSE(narrow.empty());
  EXPECT_NE(narrow[0].find("smallest gap between two fibres is 0.05 µm"), std::string::npos) << narrow[0];
  this->takePlates(0.2, 0.5);
  for (const std::string& remark : this->write(cactus::SubstrateFormat::SpinDoctor).remarks)
  {
    EXPECT_EQ(remark.find("smallest gap"), std::string::npos) << remark;
  }
}

// As MCMRSimulator.jl's reader (1.1.0) has it: keys are names of fields, corners count from 1, and other keys are errors.
TEST_F(SimulatorFolders, McmrSimulatorHasItsGeometry)
{
  this->takePlates(1.0, 0.5);
  this->Contents.startPositions = 20000; // of which some are within 1 nm of a face
  EXPECT_TRUE(this->write(cactus::SubstrateFormat::Mcmr).remarks.empty());
  const auto groups = cactus::parsedJson(contentOf(this->Scratch / "s/geometry.json"));
  ASSERT_TRUE(groups && groups->is_array() && groups->size() == 5);
  const double volumes[] = { 2 * 100 * 4.0, 2 * 64 * 2.0 };
  for (std::size_t group = 0; group < 2; ++group)
  {
    const cactus::Json& mesh = (*groups)[group];
    EXPECT_EQ(mesh.size(), 3u);
    EXPECT_EQ(mesh["type"], "Mesh");
    cactus::TriangleMesh read;
    for (const cactus::Json& point : mesh["vertices"])
    {
      ASSERT_EQ(point.size(), 3u);
      read.points.emplace_back(point[0].get<double>(), point[1].get<double>(), point[2].get<double>());
    }
    for (const cactus::Json& corners : mesh["triangles"])
    {
      ASSERT_EQ(corners.size(), 3u);
      read.triangles.push_back({ { corners[0].get<int>() - 1, corners[1].get<int>() - 1, corners[2].get<int>() - 1 } });
    }
    const cactus::SurfaceReport report = cactus::checkSurface(read);
    EXPECT_TRUE(report.sound());
    EXPECT_EQ(report.components, 2u);
    EXPECT_NEAR(report.volume, volumes[group], 1e-9);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const cactus::Json& walls = (*groups)[2 + axis];
    EXPECT_EQ(walls.size(), 3u);
    EXPECT_EQ(walls["type"], "Walls");
    for (std::size_t other = 0; other < 3; ++other)
    {
      EXPECT_EQ(walls["rotation"][other], other == axis ? 1 : 0);
    }
    EXPECT_EQ(walls["position"], cactus::Json({ -4.999, 4.999 }));
  }
  EXPECT_NE(this->readme().find("BoundingBox([-4.999, -4.999, -4.999], [4.999, 4.999, 4.999])"), std::string::npos);
  EXPECT_NE(this->readme().find("subset=[Subset(inside=2), Subset(inside=1), Subset(inside=0)]"), std::string::npos);
  EXPECT_TRUE(fs::exists(this->Scratch / "s/outer/fibre_00001.ply"));
  std::istringstream starts(contentOf(this->Scratch / "s/start/extra.txt"));
  int count = 0;
  for (double coordinate = 0.0; starts >> coordinate; ++count)
  {
    EXPECT_LE(std::fabs(coordinate), 4.999); // between the walls
  }
  EXPECT_EQ(count, 3 * this->Contents.startPositions);
}

// Its wall is in a geometry once: two in one place would be two membranes.
TEST_F(SimulatorFolders, AnAxonWithoutMyelinIsOneCompartment)
{
  this->takePlates(1.0, 0.5);
  const auto plate = this->Contents.outer.mesh(1);
  const auto axon = this->Contents.inner.mesh(0);
  this->Contents.inner = surfacesOf({ 1, 2 }, { axon, plate });
  this->write(cactus::SubstrateFormat::Mcmr);
  const auto groups = cactus::parsedJson(contentOf(this->Scratch / "s/geometry.json"));
  ASSERT_TRUE(groups && groups->is_array() && groups->size() == 5);
  EXPECT_EQ((*groups)[0]["vertices"].size(), plate.points.size());
  EXPECT_EQ((*groups)[1]["vertices"].size(), axon.points.size() + plate.points.size());
  EXPECT_NE(this->readme().find("subset=[Subset(inside=true, geometry_index=2), Subset(inside=0)]"), std::string::npos);
  EXPECT_NE(this->readme().find("1 of the fibres are axons without myelin"), std::string::npos);
  EXPECT_NE(contentOf(this->Scratch / "s/manifest.json").find("\"unmyelinated_fibres\": 1"), std::string::npos);

  this->write(cactus::SubstrateFormat::SpinDoctor);
  const std::string table = contentOf(this->Scratch / "s/compartments.csv");
  EXPECT_NE(table.find("1,axon,1,1,128\n2,axon,2,1,400\n3,myelin,1,1,272\n4,extra-axonal,0,0,200\n"), std::string::npos) << table;

  this->write(cactus::SubstrateFormat::Mcdc);
  EXPECT_EQ(contentOf(this->Scratch / "s/outer/fibre_00002.ply").size(),
    contentOf(this->Scratch / "s/inner/fibre_00002.ply").size()); // comments differ, but for the same number of letters
}

// Two caps in one plane, one of them of a repeat, throw walkers in myelin back and forth: the simulator ends with an error.
TEST_F(SimulatorFolders, McmrSimulatorRepeatsWhatIsPeriodicALittleApart)
{
  this->takePlates(1.0, 0.5);
  for (const bool isAlongZ : { false, true })
  {
    this->Contents.domain.periodic = { { true, true, isAlongZ } };
    this->write(cactus::SubstrateFormat::Mcmr);
    const auto groups = cactus::parsedJson(contentOf(this->Scratch / "s/geometry.json"));
    ASSERT_TRUE(groups && groups->is_array() && groups->size() == (isAlongZ ? 2u : 3u));
    for (std::size_t group = 0; group < 2; ++group)
    {
      EXPECT_EQ((*groups)[group]["repeats"], cactus::Json({ 10.0002, 10.0002, isAlongZ ? 10.0002 : 20 }));
    }
    if (!isAlongZ)
    {
      EXPECT_EQ((*groups)[2]["rotation"], cactus::Json({ 0, 0, 1 }));
    }
    EXPECT_NE(
      this->readme().find(isAlongZ ? "repeats after the sides" : "repeats along x and y, and Walls across z"), std::string::npos);
  }
}
