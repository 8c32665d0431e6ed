// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CrossSection.h"

#include <gtest/gtest.h>

using cactus::CrossSections;
using cactus::TriangleMesh;
using Eigen::Vector3d;

namespace
{

/// Guarantee: a search for an outline ends, even in a surface that a fault has contracted to one point, however many triangles it
/// has.
TEST(CrossSection, OfASurfaceInOnePointIsNone)
{
  TriangleMesh mesh;
  mesh.points.assign(3, Vector3d(1.0, 2.0, 3.0));
  mesh.triangles.assign(1000, { 0, 1, 2 });
  const CrossSections sections(mesh);
  EXPECT_TRUE(sections.outlineAround({ 1.0, 2.0, 3.0 }, Vector3d::UnitZ(), 0.5).empty());
  EXPECT_TRUE(sections.outlineAround({ 0.0, 0.0, 0.0 }, Vector3d::UnitZ(), 0.5).empty());
}

} // namespace
