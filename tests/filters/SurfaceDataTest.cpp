// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: surfaces of any size fit into one vtkPolyData, and are read back unchanged.
#include "SurfaceData.h"

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstddef>
#include <vector>

namespace
{

using namespace cactus;

TriangleMesh tetrahedron(double x)
{
  TriangleMesh mesh;
  mesh.points = { { x, 0.0, 0.0 }, { x + 1.0, 0.0, 0.0 }, { x, 1.0, 0.0 }, { x, 0.0, 1.0 } };
  mesh.triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } };
  return mesh;
}

/// Three surfaces of four points and twelve corners each.
std::vector<NamedSurface> surfaces()
{
  return { { 2, 1, tetrahedron(0.0) }, { 3, 1, tetrahedron(5.0) }, { 7, 2, tetrahedron(9.0) } };
}

TEST(SurfaceData, CountsWith64BitsBeyondWhat32BitsHold)
{
  constexpr std::size_t corners = 36;
  for (const std::size_t mostInShort : { corners, corners - 1 })
  {
    vtkNew<vtkPolyData> data;
    toPolyData(surfaces(), 0, data, mostInShort); // a mock of 2³¹ − 1
    EXPECT_EQ(data->GetPolys()->IsStorage64Bit(), mostInShort < corners);
    EXPECT_EQ(data->GetNumberOfCells(), 12);
    const FibreSurfaces found = surfacesFrom(data, "Outer", 0);
    EXPECT_EQ(found.fibreIds, (std::vector<int>{ 2, 3, 7 }));
    EXPECT_EQ(found.bundleIds, (std::vector<int>{ 1, 1, 2 }));
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      const TriangleMesh mesh = found.mesh(i);
      EXPECT_EQ(mesh.points, surfaces()[i].mesh.points);
      EXPECT_EQ(mesh.triangles, surfaces()[i].mesh.triangles);
    }
  }
}

} // namespace
