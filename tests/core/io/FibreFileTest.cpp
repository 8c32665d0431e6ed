// SPDX-License-Identifier: BSD-3-Clause
// Files of other generators, in the forms in which these write them.
#include "io/FibreFile.h"
#include "ScratchPath.h"
#include "base/Error.h"
#include "io/EllipsoidFile.h"
#include "io/SphereTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace
{

using cactus::FibresOfFile;

/// As CATERPillar writes them now: one axon with myelin, one without, of a single sphere, and a glial cell.
constexpr char newTable[] = "cell_type cell_id component component_id X Y Z inner_radius outer_radius\n"
                            "axon 4 axon 0 1.5 2 0 0.3 0.5\n"
                            "axon 4 axon 0 1.5 2.1 0.25 0.32 0.54\n"
                            "axon 4 axon 0 1.5 2.1 0.25 0.33 0.55\n"
                            "axon 4 axon 0 1.6 2.1 7.5 0.3 0.5\n"
                            "axon 0 axon 0 3 3 0 0.4 0.4\n"
                            "axon 0 axon 0 3 3 6 0.4 0.4\n"
                            "axon 9 axon 0 5 5 6 0.4 0.4\n"
                            "glial_cell 0 soma 0 5 5 5 2 2\n"
                            "glial_cell 0 branch 1 5 5 6 0.2 0.2\n";

/// As earlier versions did.
constexpr char oldTable[] = "id_cell id_sph id_branch Type X Y Z Rin Rout P\r\n"
                            "4 0 0 axon 1.5 2 0 0.3 0.5 -1\r\n"
                            "4 1 0 axon 1.5 2.1 0.25 0.33 0.55 0\r\n"
                            "4 2 0 axon 1.6 2.1 7.5 0.3 0.5 1\r\n"
                            "0 0 0 axon 3 3 0 0.4 0.4 -1\r\n"
                            "0 1 0 axon 3 3 6 0.4 0.4 0\r\n";

FibresOfFile spheres(const std::string& content, double side = 0.0)
{
  std::istringstream stream(content);
  return cactus::readSphereTable(stream, "some.csv", side);
}

/// Which line or axon a message speaks of.
template <typename Read>
std::string saidBy(Read&& read)
{
  try
  {
    read();
  }
  catch (const cactus::Error& error)
  {
    return error.what();
  }
  return "";
}

constexpr char ellipsoids[] =
  R"({ "randomSeed": "1", "voxelSize": [4, 4, 6], "axons": [
  { "position": [0, 0, 3], "direction": [0, 0, -6], "maxDiameter": 0.7, "color": "#aabbcc", "gRatio": 0.7, "ellipsoids": [
    { "position": [0, 0, 3], "shape": [0.5, 0, 0, 0, 0.5, 0, 0, 0, 0.5], "axonDiameter": 0.7, "myelinDiameter": 1.0 },
    { "position": [0.1, 0, 0], "shape": [0.6, 0, 0, 0, 0.6, 0, 0, 0, 0.6], "axonDiameter": 0.84, "myelinDiameter": 1.2 },
    { "position": [0, 0, -3], "shape": [0.5, 0, 0, 0, 0.5, 0, 0, 0, 0.5], "axonDiameter": 0.7, "myelinDiameter": 1.0 } ] } ],
  "cells": [ { "position": [1, 1, 1], "shape": [1, 0, 0, 0, 1, 0, 0, 0, 1], "color": "#aabbcc" } ] })";

FibresOfFile wmg(const std::string& content)
{
  std::istringstream stream(content);
  return cactus::readEllipsoidFile(stream, "config_output_10.json");
}

std::string withChange(std::string text, const std::string& what, const std::string& by)
{
  return text.replace(text.find(what), what.size(), by);
}

} // namespace

TEST(SphereTable, AxonsBecomeFibres)
{
  const FibresOfFile read = spheres(newTable);
  EXPECT_EQ(read.fibres.fibreIds, std::vector<int>({ 5, 1 }));
  EXPECT_EQ(read.fibres.offsets, std::vector<std::size_t>({ 0, 3, 5 }));
  EXPECT_EQ(read.fibres.points[1], Eigen::Vector3d(1.5, 2.1, 0.25));
  EXPECT_EQ(read.fibres.radii, std::vector<double>({ 0.5, 0.55, 0.5, 0.4, 0.4 })) << "outer ones, the larger of two in one place";
  EXPECT_NEAR(read.fibres.targetRadii[0], std::sqrt((0.25 + 0.3025 + 0.25) / 3.0), 1e-12);
  EXPECT_EQ(read.fibres.domain.lower, Eigen::Vector3d(0.0, 0.0, 0.0));
  EXPECT_EQ(read.fibres.domain.upper, Eigen::Vector3d(7.5, 7.5, 7.5)) << "nobody has said more";
  // Squares add up; the second axon has no myelin.
  EXPECT_NEAR(read.fibres.columns.value("TargetGRatio", 0),
    std::sqrt((2.0 * 0.3 * 0.3 + 0.33 * 0.33) / (2.0 * 0.5 * 0.5 + 0.55 * 0.55)), 1e-12);
  EXPECT_EQ(read.fibres.columns.value("TargetGRatio", 1), 1.0);
  ASSERT_EQ(read.remarks.size(), 3u);
  EXPECT_NE(read.remarks[1].find("2 sphere(s) of type glial_cell"), std::string::npos);
  EXPECT_NE(read.remarks[2].find("1 axon(s) of a single sphere"), std::string::npos);
}

TEST(SphereTable, EarlierVersionsHoldTheSame)
{
  const FibresOfFile read = spheres(oldTable, 8.0);
  const FibresOfFile now = spheres(newTable, 8.0);
  EXPECT_EQ(read.fibres.points, now.fibres.points);
  EXPECT_EQ(read.fibres.radii, now.fibres.radii);
  EXPECT_EQ(read.fibres.fibreIds, now.fibres.fibreIds);
  EXPECT_EQ(read.fibres.columns.value("TargetGRatio", 0), now.fibres.columns.value("TargetGRatio", 0));
  EXPECT_EQ(read.fibres.domain.upper, Eigen::Vector3d(8.0, 8.0, 8.0));
  EXPECT_TRUE(read.remarks.empty());
}

TEST(SphereTable, TheSideOfTheVoxelStandsBesideIt)
{
  namespace fs = std::filesystem;
  const fs::path folder = cactus_testing::scratchPath("caterpillar");
  fs::create_directories(folder);
  const auto write = [&](const char* name, const char* content) { std::ofstream(folder / name) << content; };
  write("run.csv", newTable);
  write("run_2.csv", newTable);
  EXPECT_EQ(cactus::sideBesideTable((folder / "run.csv").string()), 0.0);
  write("run_growth_info.txt", "Duration 1\nNum_axons 2\nVoxel Size 9\n");
  write("run_growth_info_2.txt", "Voxel Size 10\n");
  EXPECT_EQ(cactus::readFibreFile((folder / "run.csv").string()).fibres.domain.upper[2], 9.0);
  EXPECT_EQ(cactus::readFibreFile((folder / "run_2.csv").string()).fibres.domain.upper[2], 10.0);
  fs::remove_all(folder);
}

TEST(SphereTable, MistakesAreNamedByLine)
{
  const auto message = [](const std::string& what, const std::string& by)
  { return saidBy([&] { spheres(withChange(newTable, what, by)); }); };
  EXPECT_NE(message("X Y Z", "A B C").find("line 1"), std::string::npos);
  EXPECT_NE(message("2.1 0.25 0.32 0.54", "2.1 0.25 0.32").find("line 3: expected 9 columns"), std::string::npos);
  EXPECT_NE(message("2.1 0.25 0.32 0.54", "2.1 0.25x 0.32 0.54").find("line 3: expected a coordinate"), std::string::npos);
  EXPECT_NE(message("axon 4 axon 0 1.5 2 ", "axon 4.5 axon 0 1.5 2 ").find("line 2: the axon's number"), std::string::npos);
  EXPECT_NE(message("0.3 0.5\n", "0.3 -0.5\n").find("some.csv: fibre 5"), std::string::npos);
  EXPECT_NE(saidBy([] { spheres("cell_type cell_id X Y Z outer_radius\n"); }).find("no axon"), std::string::npos);
  EXPECT_NE(saidBy([] { spheres(""); }).find("line 1"), std::string::npos);
}

TEST(EllipsoidFile, AxonsBecomeFibres)
{
  const FibresOfFile read = wmg(ellipsoids);
  EXPECT_EQ(read.fibres.size(), 1u);
  EXPECT_EQ(read.fibres.points[1], Eigen::Vector3d(0.1, 0.0, 0.0));
  EXPECT_EQ(read.fibres.radii, std::vector<double>({ 0.5, 0.6, 0.5 }));
  EXPECT_NEAR(read.fibres.columns.value("TargetGRatio", 0), 0.7, 1e-12);
  EXPECT_EQ(read.fibres.domain.lower, Eigen::Vector3d(-2.0, -2.0, -3.0));
  EXPECT_EQ(read.fibres.domain.upper, Eigen::Vector3d(2.0, 2.0, 3.0));
  ASSERT_EQ(read.remarks.size(), 1u);
  EXPECT_NE(read.remarks[0].find("1 cell(s)"), std::string::npos);
  EXPECT_EQ(wmg(withChange(ellipsoids, "[4, 4, 6]", "6")).fibres.domain.upper, Eigen::Vector3d(3.0, 3.0, 3.0));
}

TEST(EllipsoidFile, MistakesAreNamed)
{
  const auto message = [](const std::string& what, const std::string& by)
  { return saidBy([&] { wmg(withChange(ellipsoids, what, by)); }); };
  EXPECT_NE(message("\"axons\"", "\"somas\"").find("is no strand file"), std::string::npos);
  EXPECT_NE(message("ellipsoids", "spheres").find("axon 1 has fewer than two ellipsoids"), std::string::npos);
  EXPECT_NE(message("[0.1, 0, 0]", "[0.1, 0]").find("has no position of three numbers"), std::string::npos);
  EXPECT_NE(message("myelinDiameter", "diameter").find("has no myelinDiameter"), std::string::npos);
  EXPECT_NE(message("[4, 4, 6]", "\"large\"").find("has no voxelSize of three numbers"), std::string::npos);
  EXPECT_NE(message("\"#aabbcc\" } ] }", "\"#aabbcc\" } ]").find("is no strand file"), std::string::npos) << "cut off";
}

TEST(FibreFile, ItsFirstCharactersTellTheFormat)
{
  const std::string path = cactus_testing::scratchPath("fibres.txt");
  const auto fibresOf = [&](const std::string& content)
  {
    std::ofstream(path) << content;
    return cactus::readFibreFile(path).fibres;
  };
  EXPECT_EQ(fibresOf(newTable).size(), 2u);
  EXPECT_EQ(fibresOf(std::string("\xef\xbb\xbf") + newTable).size(), 2u);
  EXPECT_EQ(fibresOf(std::string("\xef\xbb\xbf\n  ") + ellipsoids).size(), 1u);
  EXPECT_EQ(fibresOf("\xef\xbb\xbf 10\n1\n2\n0 0 -5 1\n0 0 5 1\n").size(), 1u);
  EXPECT_THROW(fibresOf(""), cactus::FileError);
  EXPECT_THROW(fibresOf("x,y,z\n"), cactus::FileError);
  std::filesystem::remove(path);
  EXPECT_THROW(cactus::readFibreFile(path), cactus::FileError);
}

TEST(FibreFile, IsKnownByItsContent)
{
  const auto isOne = [](const std::string& name, const std::string& content)
  {
    const std::string path = cactus_testing::scratchPath(name);
    std::ofstream(path) << content;
    const bool found = cactus::isFibreFile(path);
    std::filesystem::remove(path);
    return found;
  };
  const std::string strands = "30 20 10\n\n1\n2\n0 0 -5 1\n0 0 5 1\n";
  for (const char* name : { "a.init", "b.partial", "run.7.strands", "none.txt" })
  {
    EXPECT_TRUE(isOne(name, strands)) << name;
    EXPECT_TRUE(isOne(name, newTable)) << name;
    EXPECT_TRUE(isOne(name, ellipsoids)) << name;
  }
  EXPECT_TRUE(isOne("damaged.strands", "hello")) << "the reader says what is wrong with it";
  for (const char* other : { "<?xml version=\"1.0\"?>\n<VTKFile", "solid slab\n", "# vtk DataFile Version 3.0\n",
         "{ \"nodes\": [] }", "3\n\nO 0 0 0\n", "1\n2\n3\n4\n", "x,y,z\n1,2,3\n", "", "\x89PNG" })
  {
    EXPECT_FALSE(isOne("flow.init.vtu", other)) << other;
    EXPECT_FALSE(isOne("flow.init", other)) << other;
    EXPECT_FALSE(isOne("flow.vtu.strands", other)) << other;
  }
  EXPECT_FALSE(cactus::isFibreFile(cactus_testing::scratchPath("nowhere.strands")));
}
