// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: where a fibre's image passes a voxel or a cross-section, it has the image's direction and place.
#include "fibres/FibreShape.h"
#include "fibres/Fibres.h"
#include "judge/FibreProfile.h"
#include "judge/VoxelDirections.h"

#include <gtest/gtest.h>

using namespace cactus;

namespace
{

/// A fibre that rises steeply in the domain, and slants beyond its upper face across x, into a copy.
Fibres slanted()
{
  Fibres fibres;
  fibres.domain = Domain::cube(4.0);
  fibres.domain.periodic = { { true, true, false } };
  fibres.addFibre(1, 1, 0.4);
  fibres.addPoint({ 1.9, 0.5, -2.0 }, 0.4);
  fibres.addPoint({ 2.0, 0.5, 0.0 }, 0.4);
  fibres.addPoint({ 4.0, 0.5, 2.0 }, 0.4);
  return fibres;
}

} // namespace

TEST(PeriodicDirections, VoxelsHaveThoseOfImages)
{
  const Fibres fibres = slanted();
  VoxelBoxes voxels;
  voxels.origin.setConstant(-2.0);
  voxels.count = { { 4, 4, 4 } };
  VoxelVolumes block;
  block.count = voxels.count;
  block.volumes.assign(64, 1.0);
  const VoxelDirections found = voxelDirections(fibres, 0, voxels, block);
  const Eigen::Vector3d beyond = Eigen::Vector3d(1.0, 0.0, 1.0).normalized();
  const Eigen::Vector3d before = Eigen::Vector3d(0.1, 0.0, 2.0).normalized();
  const auto at = [&](int i, int j, int k) { return found.tensors[voxels.index(i, j, k)]; };
  // The image passes the two voxels at the lower face across x; the last one is nearest to it, too.
  EXPECT_LT((at(0, 2, 2) - beyond * beyond.transpose()).norm(), 1e-12);
  EXPECT_LT((at(1, 2, 3) - beyond * beyond.transpose()).norm(), 1e-12);
  EXPECT_LT((at(1, 1, 3) - beyond * beyond.transpose()).norm(), 1e-12);
  EXPECT_LT((at(3, 2, 0) - before * before.transpose()).norm(), 1e-12);
  EXPECT_LT((at(0, 2, 0) - before * before.transpose()).norm(), 1e-12) << "nearer through the face";
}

TEST(PeriodicDirections, CrossSectionsLieInTheDomain)
{
  const Fibres fibres = slanted();
  const std::vector<FibrePlace> places = placesAlongFibre(fibres, 0, 0.1);
  EXPECT_EQ(places.size(), 48u); // 4.83 µm
  std::size_t images = 0;
  for (const FibrePlace& place : places)
  {
    EXPECT_GT(fibres.domain.depth(place.point), 0.0);
    images += place.point.x() < 0.0 ? 1 : 0;
  }
  EXPECT_EQ(images, 28u);
  EXPECT_NEAR(lengthInDomain(fibres, 0), 4.831, 0.001);
}
