// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceIntersection.h"

#include "ExampleSurfaces.h"
#include "mesh/TriangleIntersection.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace
{

using Eigen::Vector3d;
using Lattice = Eigen::Matrix<std::int64_t, 3, 1>;
using LatticeTriangle = std::array<Lattice, 3>;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
using example::both;
using example::tetrahedron;
using example::tube;

/// Tells whether two triangles with integer coordinates have no point in common, by a plane between them: for two disjoint convex
/// polytopes, one is perpendicular to an edge, to two edges of theirs, or to a line between their corners. All in integers.
bool apart(const LatticeTriangle& a, const LatticeTriangle& b)
{
  std::vector<Lattice> directions{ a[1] - a[0], a[2] - a[1], a[0] - a[2], b[1] - b[0], b[2] - b[1], b[0] - b[2], b[0] - a[0] };
  const std::size_t count = directions.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t j = i + 1; j < count; ++j)
    {
      const Lattice cross = directions[i].cross(directions[j]);
      directions.push_back(cross);
      for (std::size_t k = 0; k < count; ++k)
      {
        directions.push_back(cross.cross(directions[k]));
      }
    }
  }
  for (const Lattice& n : directions)
  {
    const auto rangeA = std::minmax({ n.dot(a[0]), n.dot(a[1]), n.dot(a[2]) });
    const auto rangeB = std::minmax({ n.dot(b[0]), n.dot(b[1]), n.dot(b[2]) });
    if (rangeA.second < rangeB.first || rangeB.second < rangeA.first)
    {
      return true;
    }
  }
  return false;
}

std::array<Vector3d, 3> real(const LatticeTriangle& t)
{
  return { { t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>() } };
}

bool isFlat(const LatticeTriangle& t)
{
  return (t[1] - t[0]).cross(t[2] - t[0]).isZero();
}

/// Returns the self-intersections of two triangles that share their first `shared` corners.
Pairs selfIntersectionsOf(const LatticeTriangle& a, const LatticeTriangle& b, std::int32_t shared)
{
  cactus::TriangleMesh mesh;
  for (const auto& p : a)
  {
    mesh.points.push_back(p.cast<double>());
  }
  for (const auto& p : b)
  {
    mesh.points.push_back(p.cast<double>());
  }
  mesh.triangles = { { { 0, 1, 2 } }, { { 0, shared > 1 ? 1 : 4, 5 } } };
  if (shared == 0)
  {
    mesh.triangles[1][0] = 3;
  }
  return cactus::selfIntersections(cactus::TriangleTree(mesh));
}

/// The part of a triangle that is further than 1/64 of the way from its first `shared` corners, as triangles, for coordinates
/// that are multiples of 64.
std::vector<LatticeTriangle> awayFromShared(const LatticeTriangle& t, int shared)
{
  const auto near = [](const Lattice& from, const Lattice& to) -> Lattice { return from + (to - from) / 64; };
  if (shared == 2)
  {
    return { { { near(t[0], t[2]), near(t[1], t[2]), t[2] } } };
  }
  return { { { near(t[0], t[1]), t[1], t[2] } }, { { near(t[0], t[1]), near(t[0], t[2]), t[2] } } };
}

Pairs bruteForce(const cactus::TriangleMesh& a, const cactus::TriangleMesh& b)
{
  Pairs pairs;
  const auto corners = [](const cactus::TriangleMesh& mesh, std::size_t t) -> std::array<Vector3d, 3>
  {
    const auto& i = mesh.triangles[t];
    return { { mesh.points[std::size_t(i[0])], mesh.points[std::size_t(i[1])], mesh.points[std::size_t(i[2])] } };
  };
  for (std::size_t s = 0; s < a.triangles.size(); ++s)
  {
    for (std::size_t t = 0; t < b.triangles.size(); ++t)
    {
      if (cactus::trianglesMeet(corners(a, s), corners(b, t)))
      {
        pairs.emplace_back(s, t);
      }
    }
  }
  return pairs;
}

} // namespace

// Guarantee 2 rests on this: surfaces that cut each other are found, and others are left alone.
TEST(SurfaceIntersection, TellsCuttingFromApartAndNested)
{
  const auto large = tetrahedron({ 0, 0, 0 }, 3.0);
  EXPECT_TRUE(cactus::surfacesMeet(large, tetrahedron({ 0.5, 0.5, 0.5 }, 3.0)));
  EXPECT_FALSE(cactus::surfacesMeet(large, tetrahedron({ 0.5, 0.5, 0.5 }, 0.5))); // inside
  EXPECT_FALSE(cactus::surfacesMeet(large, tetrahedron({ 4, 0, 0 }, 1.0)));
  EXPECT_FALSE(cactus::surfacesMeet(large, tetrahedron({ 0.5, 0.5, -1.001 }, 1.0)));
  EXPECT_TRUE(cactus::surfacesMeet(large, tetrahedron({ 0.5, 0.5, -0.999 }, 1.0)));
}

// On a coarse lattice most triangles touch in points, lie along each other, in one plane, or degenerate to a line.
TEST(SurfaceIntersection, TrianglesMeetAsIntegersSay)
{
  std::mt19937 random(5);
  std::uniform_int_distribution<std::int64_t> coordinate(0, 3);
  std::array<std::size_t, 2> counts{};
  for (int trial = 0; trial < 60000; ++trial)
  {
    LatticeTriangle a;
    LatticeTriangle b;
    for (std::size_t i = 0; i < 3; ++i)
    {
      a[i] = { coordinate(random), coordinate(random), coordinate(random) };
      b[i] = { coordinate(random), coordinate(random), trial % 3 == 0 ? a[0][2] : coordinate(random) };
      if (trial % 3 == 0)
      {
        a[i][2] = a[0][2]; // one plane
      }
    }
    const bool wanted = !apart(a, b);
    ++counts[wanted ? 1 : 0];
    ASSERT_EQ(cactus::trianglesMeet(real(a), real(b)), wanted)
      << "a " << a[0].transpose() << ", " << a[1].transpose() << ", " << a[2].transpose() << "; b " << b[0].transpose() << ", "
      << b[1].transpose() << ", " << b[2].transpose();
    ASSERT_EQ(cactus::trianglesMeet(real(b), real(a)), wanted);
  }
  EXPECT_GT(counts[0], 10000U);
  EXPECT_GT(counts[1], 10000U);
}

// Neighbours share a corner or an edge, and may have nothing else in common.
TEST(SurfaceIntersection, NeighboursMeetAsIntegersSay)
{
  std::mt19937 random(6);
  std::uniform_int_distribution<std::int64_t> coordinate(0, 3);
  for (int shared = 1; shared <= 2; ++shared)
  {
    std::array<std::size_t, 2> counts{};
    for (int trial = 0; trial < 40000; ++trial)
    {
      LatticeTriangle a;
      LatticeTriangle b;
      for (std::size_t i = 0; i < 3; ++i)
      {
        a[i] = 64 * Lattice(coordinate(random), coordinate(random), coordinate(random));
        b[i] = 64 * Lattice(coordinate(random), coordinate(random), coordinate(random));
        if (trial % 2 == 0)
        {
          a[i][2] = a[0][2]; // one plane
          b[i][2] = a[0][2];
        }
        b[i] = int(i) < shared ? a[i] : b[i];
      }
      if (isFlat(a) || isFlat(b))
      {
        continue;
      }
      bool wanted = false;
      for (const auto& part : awayFromShared(a, shared))
      {
        wanted = wanted || !apart(part, b);
      }
      for (const auto& part : awayFromShared(b, shared))
      {
        wanted = wanted || !apart(part, a);
      }
      ++counts[wanted ? 1 : 0];
      ASSERT_EQ(selfIntersectionsOf(a, b, shared).size(), wanted ? 1U : 0U)
        << shared << " shared, a " << a[0].transpose() << ", " << a[1].transpose() << ", " << a[2].transpose() << "; b "
        << b[0].transpose() << ", " << b[1].transpose() << ", " << b[2].transpose();
    }
    EXPECT_GT(counts[0], 1000U);
    EXPECT_GT(counts[1], 1000U);
  }
}

// The tree finds every pair: compared with all pairs, on surfaces with hundreds of contacts.
TEST(SurfaceIntersection, FindsEveryMeetingPair)
{
  const auto a = tube(0, 0, 1.0, -2, 2, 24, 20, 0.1, 1);
  const auto b = tube(0.9, 0.2, 1.0, -2, 2, 20, 30, 0.1, 2);
  const Pairs wanted = bruteForce(a, b);
  EXPECT_GT(wanted.size(), 100U);
  EXPECT_EQ(cactus::meetingTriangles(cactus::TriangleTree(a), cactus::TriangleTree(b)), wanted);
  Pairs inOne;
  const auto shift = static_cast<std::uint32_t>(a.triangles.size());
  for (const auto& pair : wanted)
  {
    inOne.emplace_back(pair.first, pair.second + shift);
  }
  const auto joined = both(a, b);
  EXPECT_EQ(cactus::selfIntersections(cactus::TriangleTree(joined)), inOne);
  EXPECT_TRUE(cactus::meetsItself(joined));
  EXPECT_FALSE(cactus::meetsItself(a));
}

TEST(SurfaceIntersection, FindsASurfaceThatCutsItself)
{
  EXPECT_FALSE(cactus::meetsItself(tetrahedron({ 0, 0, 0 }, 1.0)));
  EXPECT_FALSE(cactus::meetsItself(both(tetrahedron({ 0, 0, 0 }, 1.0), tetrahedron({ 2, 0, 0 }, 1.0))));
  EXPECT_TRUE(cactus::meetsItself(both(tetrahedron({ 0, 0, 0 }, 1.0), tetrahedron({ 0.1, 0.1, 0.1 }, 1.0))));
  auto dented = tube(0, 0, 1.0, -2, 2);
  dented.points[10 * 24] = { -1.3, 0.05, 0.03 }; // a point pulled through the opposite wall
  const auto pairs = cactus::selfIntersections(cactus::TriangleTree(dented));
  ASSERT_FALSE(pairs.empty());
  for (const auto& pair : pairs)
  {
    const auto uses = [&dented](std::uint32_t t)
    {
      const auto& corners = dented.triangles[t];
      return corners[0] == 240 || corners[1] == 240 || corners[2] == 240;
    };
    EXPECT_TRUE(uses(pair.first) || uses(pair.second)) << pair.first << ", " << pair.second;
  }
}

// A point moved just through, or just onto, the face of a neighbour with which it shares a corner; folded and repeated triangles.
TEST(SurfaceIntersection, FindsFoldsBetweenNeighbours)
{
  cactus::TriangleMesh folded;
  folded.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.2, 1, 0 }, { 0.6, 0.5, 0 } };
  folded.triangles = { { { 0, 1, 2 } }, { { 1, 0, 3 } } };
  EXPECT_EQ(cactus::selfIntersections(cactus::TriangleTree(folded)), (Pairs{ { 0, 1 } }));
  folded.points[3] = { 0.6, -0.5, 0 };
  EXPECT_TRUE(cactus::selfIntersections(cactus::TriangleTree(folded)).empty());
  folded.points[3] = { 0.6, 0.5, 1e-300 };
  EXPECT_TRUE(cactus::selfIntersections(cactus::TriangleTree(folded)).empty()) << "an edge is no contact however sharp";
  folded.triangles[1] = { { 2, 1, 0 } };
  EXPECT_EQ(cactus::selfIntersections(cactus::TriangleTree(folded)), (Pairs{ { 0, 1 } })) << "the same three corners";
  folded.triangles = { { { 0, 1, 1 } } };
  EXPECT_EQ(cactus::selfIntersections(cactus::TriangleTree(folded)), (Pairs{ { 0, 0 } })) << "flat";
}

// Touching counts, down to the last digit, and one digit beside it does not.
TEST(SurfaceIntersection, TouchingIsMeetingAndLessIsNot)
{
  const double tiny = std::numeric_limits<double>::epsilon();
  const auto left = tube(0, 0, 1.0, -2, 2);
  EXPECT_TRUE(cactus::surfacesMeet(left, tube(2, 0, 1.0, -2, 2))) << "along a line";
  EXPECT_TRUE(cactus::surfacesMeet(left, tube(2 - 1e-6, 0, 1.0, -2, 2)));
  EXPECT_FALSE(cactus::surfacesMeet(left, tube(2 + 4 * tiny, 0, 1.0, -2, 2)));
  auto pointed = tetrahedron({ 0.3, 0.2, 2.0 }, 1.0); // stands with a corner on the upper cap
  pointed.points[1][2] = pointed.points[2][2] = 2.5;
  EXPECT_TRUE(cactus::surfacesMeet(left, pointed));
  pointed.points[0][2] = 2.0 + 2 * tiny;
  EXPECT_FALSE(cactus::surfacesMeet(left, pointed));
  EXPECT_TRUE(cactus::surfacesMeet(left, tube(1.2, 0.3, 1.0, 2, 5))) << "caps in one plane that overlap";
  EXPECT_FALSE(cactus::surfacesMeet(left, tube(2.2, 0.3, 1.0, 2, 5))) << "caps in one plane, side by side";
}
