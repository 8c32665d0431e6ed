// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoxedSurfaces.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "mesh/SurfaceIntersection.h"
#include "mesh/SurfaceSide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

namespace
{

using cactus::BoxedSurfaces;
using cactus::CompartmentSurface;
using cactus::Domain;
using cactus::TriangleMesh;
using Eigen::Vector3d;

/// A closed prism of 24 sides from `start` to `end` in the direction of z.
TriangleMesh prism(const Vector3d& start, double length, double radius)
{
  constexpr int sides = 24;
  TriangleMesh mesh;
  for (const double z : { 0.0, length })
  {
    for (int i = 0; i < sides; ++i)
    {
      const double angle = 2.0 * cactus::pi * i / sides;
      mesh.points.push_back(start + Vector3d(radius * std::cos(angle), radius * std::sin(angle), z));
    }
  }
  mesh.points.push_back(start);
  mesh.points.push_back(start + Vector3d(0.0, 0.0, length));
  for (std::int32_t i = 0; i < sides; ++i)
  {
    const std::int32_t next = (i + 1) % sides;
    mesh.triangles.push_back({ { i, next, sides + next } });
    mesh.triangles.push_back({ { i, sides + next, sides + i } });
    mesh.triangles.push_back({ { 2 * sides, next, i } });
    mesh.triangles.push_back({ { 2 * sides + 1, sides + i, sides + next } });
  }
  return mesh;
}

double prismVolume(double length, double radius)
{
  return length * 12.0 * radius * radius * std::sin(2.0 * cactus::pi / 24);
}

/// A quarter of a prism around the vertical edge of the cube at its lower corner, with caps on four of its faces.
TriangleMesh quarter(double half, double radius)
{
  constexpr int sides = 6;
  TriangleMesh mesh;
  for (const double z : { -half, half })
  {
    for (int i = 0; i <= sides; ++i)
    {
      const double angle = 0.5 * cactus::pi * i / sides;
      mesh.points.emplace_back(
        i == sides ? -half : -half + radius * std::cos(angle), i == 0 ? -half : -half + radius * std::sin(angle), z);
    }
    mesh.points.emplace_back(-half, -half, z);
  }
  const std::int32_t layer = sides + 2;
  for (std::int32_t i = 0; i < layer; ++i)
  {
    const std::int32_t next = (i + 1) % layer;
    mesh.triangles.push_back({ { i, next, layer + next } });
    mesh.triangles.push_back({ { i, layer + next, layer + i } });
  }
  for (std::int32_t i = 0; i < sides; ++i)
  {
    mesh.triangles.push_back({ { layer - 1, i + 1, i } });
    mesh.triangles.push_back({ { 2 * layer - 1, layer + i, layer + i + 1 } });
  }
  return mesh;
}

/// Expects that triangles meet in corners and edges only, and that every compartment's border is closed.
void expectComplex(const BoxedSurfaces& joined, std::int32_t compartments)
{
  EXPECT_FALSE(cactus::meetsItself(joined.mesh));
  for (std::int32_t compartment = -1; compartment < compartments; ++compartment)
  {
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
    for (std::size_t t = 0; t < joined.mesh.triangles.size(); ++t)
    {
      for (const int side : { 0, 1 })
      {
        for (std::size_t i = 0; joined.sides[t][std::size_t(side)] == compartment && i < 3; ++i)
        {
          const std::int32_t a = joined.mesh.triangles[t][i];
          const std::int32_t b = joined.mesh.triangles[t][(i + 1) % 3];
          ++edges[side == 0 ? std::make_pair(a, b) : std::make_pair(b, a)];
        }
      }
    }
    for (const auto& [edge, count] : edges)
    {
      EXPECT_EQ(count, (edges[{ edge.second, edge.first }])) << "compartment " << compartment;
    }
  }
}

TEST(BoxedSurfaces, FibresFromFaceToFaceAndOneThatFloats)
{
  const Domain box = Domain::cube(6.0);
  TriangleMesh axon = prism({ 1.0, 1.0, -2.98 }, 5.96, 0.6);
  for (int face = 0; face < 6; ++face)
  {
    EXPECT_EQ(cactus::extendToFace(axon, box, face, 0.5), face / 2 == 2);
  }
  const std::vector<CompartmentSurface> surfaces{ { axon, 0, 1 }, { prism({ 1.0, 1.0, -3.0 }, 6.0, 1.0), 1, 3 },
    { prism({ -1.5, -1.5, -1.0 }, 2.0, 0.8), 2, 3 } };
  const BoxedSurfaces joined = cactus::joinInBox(box, surfaces, 3);
  expectComplex(joined, 4);
  const std::vector<double> volumes = joined.volumes(4);
  EXPECT_NEAR(volumes[0], prismVolume(6.0, 0.6), 1e-9);
  EXPECT_NEAR(volumes[1], prismVolume(6.0, 1.0) - prismVolume(6.0, 0.6), 1e-9);
  EXPECT_NEAR(volumes[2], prismVolume(2.0, 0.8), 1e-9);
  EXPECT_NEAR(volumes[3], 216.0 - prismVolume(6.0, 1.0) - prismVolume(2.0, 0.8), 1e-9);
}

TEST(BoxedSurfaces, OneAcrossAnEdgeOfTheBox)
{
  const Domain box = Domain::cube(4.0);
  const TriangleMesh mesh = quarter(2.0, 1.0);
  const BoxedSurfaces joined = cactus::joinInBox(box, { { mesh, 0, 1 } }, 1);
  expectComplex(joined, 2);
  const double volume = 4.0 * 3.0 * std::sin(cactus::pi / 12);
  EXPECT_NEAR(joined.volumes(2)[0], volume, 1e-9);
  EXPECT_NEAR(joined.volumes(2)[1], 64.0 - volume, 1e-9);
}

TEST(BoxedSurfaces, EachPointLiesInItsCompartment)
{
  const Domain box = Domain::cube(6.0);
  const TriangleMesh axon = prism({ 0.0, 0.0, -3.0 }, 6.0, 0.9);
  const TriangleMesh fibre = prism({ 0.0, 0.0, -3.0 }, 6.0, 1.0);
  const TriangleMesh corner = quarter(3.0, 2.0);
  const BoxedSurfaces joined = cactus::joinInBox(box, { { axon, 0, 1 }, { fibre, 1, 3 }, { corner, 2, 3 } }, 3);
  const auto points = joined.pointsInside();
  ASSERT_EQ(points.size(), 4u);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(points[i].compartment, std::int32_t(i));
    const auto isIn = [&](const TriangleMesh& mesh)
    { return cactus::sideOf(cactus::TriangleTree(mesh), points[i].point) == cactus::Side::Inside; };
    EXPECT_EQ(isIn(axon), i == 0);
    EXPECT_EQ(isIn(fibre), i <= 1);
    EXPECT_EQ(isIn(corner), i == 2);
    EXPECT_GT(box.depth(points[i].point), 0.0);
  }
}

TEST(BoxedSurfaces, WithoutSurfacesTheBoxIsAllAround)
{
  const BoxedSurfaces joined = cactus::joinInBox(Domain::cube(2.0), {}, 0);
  EXPECT_EQ(joined.mesh.triangles.size(), 12u);
  EXPECT_NEAR(joined.volumes(1)[0], 8.0, 1e-12);
}

TEST(BoxedSurfaces, OnlyFlatEndsNearAFaceAreExtended)
{
  const Domain box = Domain::cube(6.0);
  TriangleMesh far = prism({ 0.0, 0.0, -2.0 }, 4.0, 1.0);
  TriangleMesh pointed = far;
  pointed.points.back()[2] = 2.9;
  TriangleMesh beside = prism({ 1.98, 0.0, -2.0 }, 4.0, 1.0); // an edge of its wall lies near a face, but no triangle does
  for (int face = 0; face < 6; ++face)
  {
    EXPECT_FALSE(cactus::extendToFace(far, box, face, 0.5));
    EXPECT_FALSE(cactus::extendToFace(pointed, box, face, 0.5));
    EXPECT_FALSE(cactus::extendToFace(beside, box, face, 0.5));
  }
}

TEST(BoxedSurfaces, WhatBoundsNothingIsRefused)
{
  const Domain box = Domain::cube(6.0);
  TriangleMesh open = prism({ 0.0, 0.0, -2.0 }, 4.0, 1.0);
  open.triangles.pop_back();
  EXPECT_THROW(cactus::joinInBox(box, { { open, 0, 1 } }, 1), cactus::InvalidInput);
  EXPECT_THROW(cactus::joinInBox(box, { { prism({ 0.0, 0.0, -2.0 }, 8.0, 1.0), 0, 1 } }, 1), cactus::InvalidInput);
  const std::vector<CompartmentSurface> crossing{ { prism({ 0.0, 0.0, -3.0 }, 6.0, 1.0), 0, 2 },
    { prism({ 0.5, 0.0, -3.0 }, 6.0, 1.0), 1, 2 } };
  EXPECT_THROW(cactus::joinInBox(box, crossing, 2), cactus::InvalidInput);
}

} // namespace
