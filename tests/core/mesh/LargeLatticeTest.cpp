// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a fibre at the far end of a lattice with more than 2³¹ blocks and 2⁴² nodes has the same surface as in a small one.
#include "mesh/ExampleContours.h"
#include "mesh/Isosurface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace cactus;

/// Makes two blocks along x, one along y and z, in a lattice that begins so many blocks before them.
NodeLattice latticeBefore(int blocks)
{
  constexpr int farthest = 1300 * NodeLattice::blockCells;
  NodeLattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int own = (axis == 0 ? 2 : 1) * NodeLattice::blockCells;
    for (int i = farthest - own - blocks * NodeLattice::blockCells; i <= farthest; ++i)
    {
      lattice.planes[axis].push_back(0.05 * i);
    }
  }
  return lattice;
}

TEST(LargeLattice, HasTheSurfacesOfASmallOne)
{
  const auto ball = [](const NodeLattice& lattice)
  {
    const std::array<int, 3> last{ { lattice.cells(0), lattice.cells(1), lattice.cells(2) } };
    return example::sampled(
      [last](int i, int j, int k) {
        return 5.3 - std::sqrt(std::pow(last[0] - i - 16.2, 2) + std::pow(last[1] - j - 8.1, 2) + std::pow(last[2] - k - 7.7, 2));
      });
  };
  const NodeLattice small = latticeBefore(0);
  ASSERT_EQ(small.blockCount(), 2u);
  const NodeLattice large = latticeBefore(1298);
  ASSERT_GT(large.blockCount(), std::size_t(1) << 31);
  const auto end = static_cast<std::uint32_t>(large.blockCount());
  const CappedSurface wanted = contour(small, { 0, 1 }, ball(small));
  const CappedSurface found = contour(large, { end - 2, end - 1 }, ball(large));
  ASSERT_GT(wanted.mesh.points.size(), 300u);
  EXPECT_EQ(found.mesh.triangles, wanted.mesh.triangles);
  EXPECT_EQ(found.mesh.points, wanted.mesh.points);
}

} // namespace
