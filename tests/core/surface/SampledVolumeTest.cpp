// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: the sampled volume is that of the contour at the same level, up to a shift by a fiftieth of a voxel, or twice that
// along an axis; the level of a volume is found, or the nearer end if there is none; boxes fill the domain up to its faces.
#include "surface/SampledVolume.h"
#include "base/Constants.h"
#include "surface/FibreContours.h"
#include "surface/FibreSurvey.h"
#include "surface/NearBlocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace
{

using namespace cactus;

constexpr double spacing = 0.1;
constexpr double gap = 0.035;

/// A label image of one fibre along z, in the middle or oblique, from one edge of the box's lower face to the opposite one above.
struct Image
{
  VoxelGrid grid;
  std::vector<std::int32_t> ids;
  std::vector<float> depths;

  explicit Image(double radius, double slant)
  {
    grid.spacing = spacing;
    grid.origin = Eigen::Vector3d::Constant(-1.95);
    grid.count = { { 40, 40, 40 } };
    const Eigen::Vector3d axis = Eigen::Vector3d(slant, 0.5 * slant, 1.0).normalized();
    for (int k = 0; k < 40; ++k)
    {
      for (int j = 0; j < 40; ++j)
      {
        for (int i = 0; i < 40; ++i)
        {
          const Eigen::Vector3d p = grid.position(i, j, k);
          const double depth = radius - (p - p.dot(axis) * axis).norm();
          ids.push_back(depth > 0.0 ? 1 : 0);
          depths.push_back(static_cast<float>(depth));
        }
      }
    }
  }
  LabelImageView view() const { return { grid, ids.data(), depths.data(), gap }; }
};

SmoothedField fieldOf(const FibreField& field)
{
  return SmoothedField(field, 1, blocksNear(field, findFibres(field).at(1), 0), 0);
}

TEST(SampledVolume, IsThatOfContours)
{
  for (const double radius : { 0.45, 0.7, 1.3 })
  {
    for (const double slant : { 0.0, 0.15, 0.6 })
    {
      const Image image(radius, slant);
      const FibreField field(image.view(), Domain::cube(4.0), true);
      const SmoothedField smoothed = fieldOf(field);
      const FibreContours contours(field, 0.02, 1e-4, nullptr);
      const SampledVolume sampled = contours.innerVolumes(smoothed, 0.05);
      // Along an axis all cuts meet the samples alike, so that errors do not cancel.
      const double slack = (slant == 0.0 ? 0.04 : 0.02) * spacing;
      for (const double level : { 0.1, 0.15, 0.217, 0.3 * radius })
      {
        double dropped = 0.0;
        const SurfaceMeasure contour = measure(contours.innerAt(smoothed, level, nullptr, dropped));
        EXPECT_NEAR(sampled.at(level), contour.volume, slack * contour.freeArea) << radius << ' ' << slant << ' ' << level;
        EXPECT_NEAR(sampled.levelOf(contour.volume, 0.05, radius), level, slack);
      }
    }
  }
}

TEST(SampledVolume, ReachesTheFacesOfTheDomain)
{
  const Image image(0.8, 0.0);
  // The domain ends between samples, and the fibre's side is cut off.
  Domain domain = Domain::cube(4.0);
  domain.lower = Eigen::Vector3d(-0.413, -1.5, -1.777);
  const FibreField field(image.view(), domain, true);
  const SampledVolume sampled(fieldOf(field), field.lattice(), 0.1);
  const double radius = 0.8 - 0.2;
  const double distance = 0.413;
  const double segment =
    radius * radius * std::acos(distance / radius) - distance * std::sqrt(radius * radius - distance * distance);
  const double length = 2.0 + 1.777;
  EXPECT_NEAR(sampled.at(0.2), length * (pi * radius * radius - segment), 0.04 * spacing * length * 2.0 * pi * radius);
}

TEST(SampledVolume, EndsAtTheNearestLevel)
{
  const Image image(0.7, 0.15);
  const FibreField field(image.view(), Domain::cube(4.0), true);
  const SampledVolume sampled(fieldOf(field), field.lattice(), 0.1);
  EXPECT_NEAR(sampled.levelOf(100.0, 0.1, 0.6), 0.1, 1e-4);
  EXPECT_NEAR(sampled.levelOf(0.0, 0.1, 0.6), 0.6, 1e-4);
  EXPECT_GT(sampled.deepest(), 0.6);
  EXPECT_LE(sampled.deepest(), 0.7);
  const SampledVolume none(SmoothedField(field, 2, {}, 0), field.lattice(), 0.1);
  EXPECT_EQ(none.deepest(), 0.1);
  EXPECT_EQ(none.at(0.2), 0.0);
}

} // namespace
