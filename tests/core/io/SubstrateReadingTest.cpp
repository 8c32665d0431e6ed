// SPDX-License-Identifier: BSD-3-Clause
#include "io/SubstrateReading.h"

#include "ExampleSurfaces.h"
#include "ScratchPath.h"
#include "base/Error.h"
#include "io/SubstrateFolder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace
{

/// Makes straight fibres along z with these ids and places on the x axis, each in a bundle of its own.
cactus::Fibres fibresAt(const std::vector<std::pair<int, double>>& places)
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  for (const auto& [id, x] : places)
  {
    fibres.addFibre(id, id + 1, 1.0);
    fibres.addPoint({ x, 0.0, -6.0 }, 1.0);
    fibres.addPoint({ x, 0.0, 6.0 }, 1.0);
  }
  return fibres;
}

/// A folder with the fibres and some surface.
class ReadSubstrate : public ::testing::Test
{
protected:
  void SetUp() override { std::filesystem::remove_all(this->Folder); }
  void TearDown() override { std::filesystem::remove_all(this->Folder); }

  cactus::SubstrateDescription write(const cactus::Fibres& fibres)
  {
    cactus::TriangleMesh mesh;
    mesh.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    mesh.triangles = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 0, 3, 2 } }, { { 1, 2, 3 } } };
    cactus::SubstrateFolderContents contents;
    contents.domain = fibres.domain;
    contents.format = cactus::SubstrateFormat::Surfaces;
    contents.fibres = &fibres;
    contents.outer = example::surfacesOf({ fibres.fibreIds.front() }, { mesh });
    cactus::writeSubstrateFolder(contents, this->Folder);
    return cactus::describeSubstrate(this->Folder);
  }

  std::string Folder = cactus_testing::scratchPath("read-substrate");
};

} // namespace

TEST_F(ReadSubstrate, DescribesItsSurfaces)
{
  const cactus::SubstrateDescription substrate = this->write(fibresAt({ { 7, 1.0 } }));
  ASSERT_EQ(substrate.files.size(), 1u);
  EXPECT_EQ(substrate.files[0].path, "outer/fibre_00007.ply");
  EXPECT_EQ(substrate.files[0].fibreId, 7);
  EXPECT_EQ(substrate.files[0].triangles, 4u);
  EXPECT_EQ(substrate.domain.upper.x(), 5.0);
  EXPECT_EQ(substrate.strands, "fibres.strands");
  EXPECT_TRUE(cactus::isSubstrate(this->Folder));
  EXPECT_TRUE(cactus::isSubstrate(this->Folder + "/manifest.json"));
  EXPECT_FALSE(cactus::isSubstrate(this->Folder + "/README.txt"));
  EXPECT_FALSE(cactus::isSubstrate(this->Folder + "/outer"));
  EXPECT_NO_THROW(cactus::fileAsWritten(substrate, "outer/fibre_00007.ply"));
  EXPECT_THROW(cactus::fileAsWritten(substrate, "manifest.json"), cactus::FileError);
}

/// Line 40 is outside the domain.
TEST_F(ReadSubstrate, LinesGetTheirIdsBack)
{
  const cactus::Fibres fibres = fibresAt({ { 9, 1.0 }, { 2, -1.0 }, { 40, 8.0 } });
  const auto read = cactus::centreLines(this->write(fibres));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->fibreIds, (std::vector<int>{ 2, 9, 40 }));
  EXPECT_EQ(read->bundleIds, (std::vector<int>{ 3, 10, 41 }));
  EXPECT_EQ(read->points[0].x(), -1.0);
  EXPECT_EQ(read->points[2].x(), 1.0);
}

TEST_F(ReadSubstrate, LinesOfOlderFoldersAreNobodys)
{
  cactus::SubstrateDescription substrate = this->write(fibresAt({ { 2, -1.0 }, { 9, 1.0 } }));
  substrate.strandFibres.pop_back();
  EXPECT_THROW(cactus::centreLines(substrate), cactus::FileError) << "one for each line";
  substrate.strandFibres.clear();
  EXPECT_FALSE(cactus::centreLines(substrate));
}
