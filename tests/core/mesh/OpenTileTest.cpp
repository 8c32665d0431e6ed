// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/OpenTile.h"

#include "ExampleSurfaces.h"
#include "base/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace
{

using cactus::Domain;
using cactus::openAtPeriodicFaces;
using cactus::TriangleMesh;
using Eigen::Vector3d;

Domain periodicCube(double side, bool alongZ = true)
{
  Domain domain = Domain::cube(side);
  domain.periodic = { { true, true, alongZ } };
  return domain;
}

/// The edges with a triangle on one side alone.
std::size_t openEdgeCount(const TriangleMesh& mesh)
{
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  for (const auto& t : mesh.triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      ++uses[std::minmax(t[i], t[(i + 1) % 3])];
    }
  }
  return std::size_t(std::count_if(uses.begin(), uses.end(), [](const auto& edge) { return edge.second == 1; }));
}

std::string refusal(const TriangleMesh& mesh, const Domain& domain)
{
  try
  {
    openAtPeriodicFaces(mesh, domain);
  }
  catch (const cactus::InvalidInput& error)
  {
    return error.what();
  }
  return "";
}

TEST(OpenTile, DropsCapsAndNothingElse)
{
  const TriangleMesh opened = openAtPeriodicFaces(example::box({ -1, -1, -4 }, { 1, 1, 4 }), periodicCube(8.0));
  EXPECT_EQ(opened.triangles.size(), 8u);
  EXPECT_EQ(opened.points.size(), 8u);
  EXPECT_EQ(openEdgeCount(opened), 8u);
}

// Inner surfaces end a little before the faces.
TEST(OpenTile, ExtendsEndsToTheFaces)
{
  const TriangleMesh axon = example::box({ -0.5, -0.5, -3.98 }, { 0.5, 0.5, 3.98 });
  const TriangleMesh opened = openAtPeriodicFaces(axon, periodicCube(8.0));
  EXPECT_EQ(opened.triangles.size(), 8u);
  EXPECT_TRUE(std::all_of(opened.points.begin(), opened.points.end(), [](const Vector3d& p) { return std::abs(p.z()) == 4.0; }));
}

// What lies nearer to a face than twice the distance at which the surface ends is stretched with it: nothing comes to lie beyond
// anything else.
TEST(OpenTile, StretchesWhatLiesBeforeTheFaces)
{
  TriangleMesh axon;
  const double heights[] = { -3.875, -3.75, 3.0, 3.8125, 3.875 };
  for (const double z : heights)
  {
    for (const auto& [x, y] : { std::pair(-0.5, -0.5), std::pair(0.5, -0.5), std::pair(0.0, 0.5) })
    {
      axon.points.emplace_back(x, y, z);
    }
  }
  for (std::int32_t ring = 0; ring < 12; ring += 3)
  {
    for (std::int32_t i = 0; i < 3; ++i)
    {
      const std::int32_t j = (i + 1) % 3;
      axon.triangles.push_back({ { ring + i, ring + j, ring + 3 + i } });
      axon.triangles.push_back({ { ring + j, ring + 3 + j, ring + 3 + i } });
    }
  }
  axon.triangles.push_back({ { 0, 2, 1 } });
  axon.triangles.push_back({ { 12, 13, 14 } });
  const TriangleMesh opened = openAtPeriodicFaces(axon, periodicCube(8.0));
  ASSERT_EQ(opened.points.size(), axon.points.size());
  EXPECT_EQ(opened.triangles.size(), axon.triangles.size() - 2);
  const double extended[] = { -4.0, -3.75, 3.0, 3.875, 4.0 };
  for (std::size_t p = 0; p < opened.points.size(); ++p)
  {
    EXPECT_EQ(opened.points[p], Vector3d(axon.points[p].x(), axon.points[p].y(), extended[p / 3])) << p;
  }
}

// Its flat ends are no caps: they do not lie at a face.
TEST(OpenTile, LeavesASurfaceInTheMiddle)
{
  const TriangleMesh box = example::box({ -1, -1, -1 }, { 1, 1, 1 });
  const TriangleMesh opened = openAtPeriodicFaces(box, periodicCube(8.0));
  EXPECT_EQ(opened.triangles, box.triangles);
  EXPECT_EQ(opened.points, box.points);
}

TEST(OpenTile, KeepsCapsAcrossOtherAxes)
{
  const TriangleMesh opened = openAtPeriodicFaces(example::box({ -4, -1, -4 }, { 4, 1, 4 }), periodicCube(8.0, false));
  EXPECT_EQ(opened.triangles.size(), 8u); // x is open, z is not
  const TriangleMesh all = openAtPeriodicFaces(example::box({ -4, -1, -4 }, { 4, 1, 4 }), periodicCube(8.0));
  EXPECT_EQ(all.triangles.size(), 4u);
}

TEST(OpenTile, RefusesWhatDoesNotJoin)
{
  TriangleMesh bent = example::box({ -1, -1, -4 }, { 1, 1, 4 });
  bent.points[7].x() += 1e-12;
  EXPECT_EQ(refusal(bent, periodicCube(8.0)), " does not end alike in the two faces across z");
  const TriangleMesh stump = example::box({ -1, -1, -4 }, { 1, 1, 3 });
  EXPECT_EQ(refusal(stump, periodicCube(8.0)), " does not end alike in the two faces across z");
  TriangleMesh leaking = example::box({ -1, -1, -4 }, { 1, 1, 4 });
  leaking.triangles.pop_back();
  EXPECT_EQ(refusal(leaking, periodicCube(8.0)), " is not closed");
}

} // namespace
