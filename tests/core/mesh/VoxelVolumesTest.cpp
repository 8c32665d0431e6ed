// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: the volume of a surface in each voxel is exact, wherever the surface lies on the grid, and the part outside the grid
// does not count.
#include "mesh/VoxelVolumes.h"

#include "ExampleSurfaces.h"
#include "Sanitized.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace
{

using cactus::TriangleMesh;
using cactus::VoxelBoxes;
using Eigen::Vector3d;

VoxelBoxes grid(const Vector3d& origin, double spacing, int n)
{
  return { origin, spacing, { { n, n, n } } };
}

double overlap(double low, double high, double from, double to)
{
  return std::max(0.0, std::min(high, to) - std::max(low, from));
}

TEST(VoxelVolumes, OfABoxAreProductsOfOverlaps)
{
  // On the voxels' faces, between them, thinner than a voxel, larger than the grid, and beside it.
  const VoxelBoxes voxels = grid({ -2, -1, 0 }, 0.5, 8);
  for (const auto& [lower, upper] : std::vector<std::pair<Vector3d, Vector3d>>{ { { -1, 0, 1 }, { 1, 1, 2 } },
         { { -1.3, 0.1, 0.7 }, { 1.21, 2.77, 2.3 } }, { { 0.1, 0.1, 0.1 }, { 0.2, 0.2, 3.9 } }, { { -9, -9, -9 }, { 9, 9, 9 } },
         { { -9, 0.2, 0.1 }, { -8, 1, 1 } }, { { 0, 0, 0 }, { 9, 0.3, 9 } } })
  {
    const auto found = cactus::voxelVolumes(example::box(lower, upper), voxels);
    double sum = 0.0;
    std::size_t place = 0;
    for (int k = 0; k < found.count[2]; ++k)
    {
      for (int j = 0; j < found.count[1]; ++j)
      {
        for (int i = 0; i < found.count[0]; ++i, ++place)
        {
          double wanted = 1.0;
          for (int axis = 0; axis < 3; ++axis)
          {
            const int number = found.lower[std::size_t(axis)] + (axis == 0 ? i : axis == 1 ? j : k);
            const double from = voxels.origin[axis] + voxels.spacing * number;
            wanted *= overlap(lower[axis], upper[axis], from, from + voxels.spacing);
          }
          EXPECT_NEAR(found.volumes[place], wanted, 1e-13);
          sum += found.volumes[place];
        }
      }
    }
    EXPECT_EQ(place, found.volumes.size());
    EXPECT_NEAR(
      sum, overlap(lower[0], upper[0], -2, 2) * overlap(lower[1], upper[1], -1, 3) * overlap(lower[2], upper[2], 0, 4), 1e-11);
  }
}

TEST(VoxelVolumes, OfTetrahedraAgreeWithCountedPoints)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-0.4, 2.4);
  const auto point = [&] { return Vector3d(anywhere(random), anywhere(random), anywhere(random)); };
  const VoxelBoxes voxels = grid({ 0, 0, 0 }, 1.0, 2);
  for (int round = 0; round < cactus::fewerWhereSanitized(20); ++round)
  {
    const Vector3d a = point(), b = point(), c = point(), d = point();
    Eigen::Matrix3d edges;
    edges << b - a, c - a, d - a;
    if (std::abs(edges.determinant()) < 0.3)
    {
      continue;
    }
    const auto found = cactus::voxelVolumes(example::tetrahedronOf(a, b, c, d), voxels);
    const Eigen::Matrix3d inverse = edges.inverse();
    std::vector<double> counted(8, 0.0);
    constexpr int n = 60; // a side
    for (int i = 0; i < 8 * n * n * n; ++i)
    {
      const Vector3d p = (Vector3d(i % (2 * n), i / (2 * n) % (2 * n), i / (4 * n * n)) + Vector3d::Constant(0.5)) / n;
      const Vector3d parts = inverse * (p - a);
      if (parts.minCoeff() >= 0.0 && parts.sum() <= 1.0)
      {
        counted[voxels.index(int(p[0]), int(p[1]), int(p[2]))] += 1.0 / (n * n * n);
      }
    }
    std::vector<double> exact(8, 0.0);
    for (std::size_t place = 0; place < found.volumes.size(); ++place)
    {
      const int i = int(place) % found.count[0], j = int(place) / found.count[0] % found.count[1];
      const int k = int(place) / (found.count[0] * found.count[1]);
      exact[voxels.index(found.lower[0] + i, found.lower[1] + j, found.lower[2] + k)] = found.volumes[place];
    }
    for (std::size_t voxel = 0; voxel < 8; ++voxel)
    {
      EXPECT_NEAR(exact[voxel], counted[voxel], 2e-3) << round << ' ' << voxel;
    }
  }
}

TEST(VoxelVolumes, OfATetrahedronAddUpOnAFineGrid)
{
  const TriangleMesh mesh = example::tetrahedronOf({ 0.01, 0.3, 0.2 }, { 2.9, 0.7, 0.11 }, { 0.5, 2.6, 0.4 }, { 1.1, 0.9, 2.99 });
  const double wanted =
    std::abs((mesh.points[1] - mesh.points[0]).cross(mesh.points[2] - mesh.points[0]).dot(mesh.points[3] - mesh.points[0])) / 6.0;
  for (const int n : { 1, 7, 40 })
  {
    const auto found = cactus::voxelVolumes(mesh, grid({ 0, 0, 0 }, 3.0 / n, n));
    EXPECT_NEAR(std::accumulate(found.volumes.begin(), found.volumes.end(), 0.0), wanted, 1e-12);
    for (const double volume : found.volumes)
    {
      EXPECT_GE(volume, -1e-15);
      EXPECT_LE(volume, std::pow(3.0 / n, 3) * (1.0 + 1e-12));
    }
  }
}

} // namespace
