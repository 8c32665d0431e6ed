// SPDX-License-Identifier: BSD-3-Clause
// Contours for tests.
#pragma once

#include "mesh/Isosurface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

namespace example
{

using cactus::CappedSurface;
using cactus::NodeLattice;
using cactus::NodeRange;

/// A cube around the origin.
inline NodeLattice cubeLattice(int nodes, double spacing)
{
  NodeLattice lattice;
  for (auto& planes : lattice.planes)
  {
    for (int i = 0; i < nodes; ++i)
    {
      planes.push_back(spacing * (i - 0.5 * (nodes - 1)));
    }
  }
  return lattice;
}

inline std::vector<std::uint32_t> allBlocks(const NodeLattice& lattice)
{
  std::vector<std::uint32_t> blocks(lattice.blockCount());
  std::iota(blocks.begin(), blocks.end(), 0u);
  return blocks;
}

/// Returns the values of a function of the nodes' indices.
inline std::function<void(const NodeRange&, float*)> sampled(const std::function<double(int, int, int)>& field)
{
  return [field](const NodeRange& range, float* out)
  {
    for (int k = 0; k < range.count[2]; ++k)
    {
      for (int j = 0; j < range.count[1]; ++j)
      {
        for (int i = 0; i < range.count[0]; ++i)
        {
          *out++ = static_cast<float>(field(range.first[0] + i, range.first[1] + j, range.first[2] + k));
        }
      }
    }
  };
}

/// Depth below the surface of a sphere that lies a little beside the origin.
inline double sphereDepth(const Eigen::Vector3d& p, double radius)
{
  return radius - (p - Eigen::Vector3d(0.013, -0.021, 0.007)).norm();
}

inline CappedSurface sphere(double radius, double spacing, int nodes)
{
  const NodeLattice lattice = cubeLattice(nodes, spacing);
  const double half = 0.5 * (nodes - 1);
  return cactus::contour(lattice, allBlocks(lattice),
    sampled([=](int i, int j, int k) { return sphereDepth(spacing * Eigen::Vector3d(i - half, j - half, k - half), radius); }));
}

/// The parts of a ball of radius 0.8 around `centre` and of a small ball that lie in the box [-1, 1]³.
inline CappedSurface ballInBox(
  const Eigen::Vector3d& centre, const Eigen::Vector3d& smallCentre = Eigen::Vector3d::Zero(), double smallRadius = -1.0)
{
  NodeLattice lattice;
  for (auto& planes : lattice.planes)
  {
    for (int i = 0; i <= 40; ++i)
    {
      planes.push_back(-1.0 + 0.05 * i);
    }
  }
  std::vector<std::uint32_t> blocks(lattice.blockCount());
  std::iota(blocks.begin(), blocks.end(), 0u);
  return cactus::contour(lattice, blocks,
    [&](const NodeRange& range, float* out)
    {
      for (int k = 0; k < range.count[2]; ++k)
      {
        for (int j = 0; j < range.count[1]; ++j)
        {
          for (int i = 0; i < range.count[0]; ++i, ++out)
          {
            const Eigen::Vector3d p = Eigen::Vector3d::Constant(-1.0) +
                                      0.05 * Eigen::Vector3d(range.first[0] + i, range.first[1] + j, range.first[2] + k);
            const double big = 0.8 - (p - centre).norm();
            const double small = smallRadius - (p - smallCentre).norm();
            *out = static_cast<float>(std::max(big, small) + 1e-5);
          }
        }
      }
    });
}

} // namespace example
