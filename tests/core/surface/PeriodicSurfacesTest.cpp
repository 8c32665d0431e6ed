// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: the label image of a periodic domain goes on beyond its faces; the rims of surfaces in two opposite faces have the
// same points, bit for bit, also where surfaces are coarsened; copies of the domain side by side fit together; without their caps
// axons reach to the faces and meet neither themselves nor their outer surfaces.
#include "BundleBetweenWalls.h"
#include "base/Error.h"
#include "bundle/BundleInitializer.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"
#include "mesh/OpenTile.h"
#include "mesh/SurfaceIntersection.h"
#include "optimiser/CapsuleOptimizer.h"
#include "surface/FibreField.h"
#include "surface/MyelinSurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace
{

using namespace cactus;

/// A small optimised bundle in a periodic domain, grown.
struct PeriodicTissue
{
  Fibres fibres;
  FibreRadialGrowthOptions growth;
  double grown = 0.0;
  LabelImageFacts facts;

  explicit PeriodicTissue(Border border, double side = 6.0)
  {
    BundleInitializerOptions options;
    options.border = border;
    options.side = side;
    options.radius.maximum = 0.25 * side;
    options.meanDispersion = 8.0;
    this->fibres = initialiseBundles(options);
    optimise(this->fibres, {}, {});
    this->fibres = aimAtTargetRadii(this->fibres, this->growth);
    this->grown = growthFor(this->fibres, this->growth).growth;
    this->facts.domain = this->fibres.domain;
    this->facts.fibreIds = this->fibres.fibreIds;
    this->facts.bundleIds = this->fibres.bundleIds;
    this->facts.targetRadii = this->fibres.targetRadii;
    this->facts.minimumGap = this->growth.minimumGap;
    this->facts.surfaceTolerance = this->growth.surfaceTolerance;
    this->facts.centreLines = std::make_shared<Fibres>(this->fibres);
  }

  LabelImage image(double margin = 0.0) const
  {
    FibreRadialGrowthOptions options = this->growth;
    options.margin = margin;
    return growFibres(this->fibres, options, this->grown, growthGrid(this->fibres.domain, options));
  }

  std::vector<FibreSurfacePair> surfaces(const MyelinSurfaceOptions& options) const
  {
    const LabelImage held = this->image();
    return myelinSurfaces({ held.grid, held.fibreId.data(), held.depth.data(), this->growth.gap() }, this->facts, options);
  }
};

/// The places, in their plane, of the points in which the wall of a surface ends at a face; those of caps alone are none.
std::set<std::array<double, 2>> rimOf(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box, int face)
{
  const auto isOn = [&](std::int32_t p, int f)
  { return mesh.points[std::size_t(p)][f / 2] == (f % 2 == 0 ? box.min()[f / 2] : box.max()[f / 2]); };
  std::set<std::array<double, 2>> rim;
  for (const auto& t : mesh.triangles)
  {
    bool isCap = false;
    for (int f = 0; f < 6; ++f)
    {
      isCap = isCap || (isOn(t[0], f) && isOn(t[1], f) && isOn(t[2], f));
    }
    for (std::size_t i = 0; i < 3 && !isCap; ++i)
    {
      if (isOn(t[i], face) && isOn(t[(i + 1) % 3], face))
      {
        for (const std::int32_t p : { t[i], t[(i + 1) % 3] })
        {
          const Eigen::Vector3d& place = mesh.points[std::size_t(p)];
          rim.insert({ { place[(face / 2 + 1) % 3], place[(face / 2 + 2) % 3] } });
        }
      }
    }
  }
  return rim;
}

/// The box that the surfaces of one kind fill.
Eigen::AlignedBox3d boxOf(const std::vector<FibreSurfacePair>& pairs, TriangleMesh FibreSurfacePair::*kind)
{
  Eigen::AlignedBox3d box;
  for (const FibreSurfacePair& pair : pairs)
  {
    for (const Eigen::Vector3d& point : (pair.*kind).points)
    {
      box.extend(point);
    }
  }
  return box;
}

TEST(PeriodicGrowth, TheImageGoesOnBeyondTheFaces)
{
  const PeriodicTissue tissue(Border::Periodic);
  const LabelImage image = tissue.image(0.8);
  const int count = static_cast<int>(std::lround(tissue.fibres.domain.size().x() / image.grid.spacing));
  const int margin = 8;
  ASSERT_EQ(image.grid.count[0], count + 2 * margin);
  int compared = 0;
  for (int k = 0; k < image.grid.count[2]; ++k)
  {
    for (int j = 0; j < image.grid.count[1]; ++j)
    {
      for (int i = 0; i < image.grid.count[0]; ++i)
      {
        const auto inside = [&](int n) { return (n - margin + count) % count + margin; };
        const std::size_t here = image.grid.index(i, j, k);
        const std::size_t there = image.grid.index(inside(i), inside(j), inside(k));
        ASSERT_EQ(image.fibreId[here], image.fibreId[there]) << i << ' ' << j << ' ' << k;
        ASSERT_NEAR(image.depth[here], image.depth[there], 2e-6);
        compared += here != there ? 1 : 0;
      }
    }
  }
  EXPECT_GT(compared, 100000);
}

TEST(PeriodicSurfaces, RimsOfOppositeFacesHaveTheSamePoints)
{
  for (const Border border : { Border::Periodic, Border::PeriodicAcross })
  {
    const PeriodicTissue tissue(border);
    MyelinSurfaceOptions fine;
    fine.decimationError = 0.0;
    MyelinSurfaceOptions nodes;
    nodes.myelinFollowsAxon = true;
    nodes.swellingAmplitude = 0.2;
    nodes.swellingSpacing = 3.0;
    nodes.swellingLength = 1.0;
    nodes.nodeLength = 0.8;
    nodes.paranodeLength = 0.8;
    nodes.internodeFactor = 2.0;
    MyelinSurfaceOptions swollen = nodes;
    swollen.myelinFollowsAxon = false;
    swollen.nodeLength = 0.0;
    swollen.swellingAmplitude = 0.1;
    for (const MyelinSurfaceOptions& options : { MyelinSurfaceOptions(), fine, nodes, swollen })
    {
      const std::vector<FibreSurfacePair> pairs = tissue.surfaces(options);
      for (const auto kind : { &FibreSurfacePair::outer, &FibreSurfacePair::inner })
      {
        const Eigen::AlignedBox3d box = boxOf(pairs, kind);
        std::array<std::size_t, 3> points{};
        for (const FibreSurfacePair& pair : pairs)
        {
          EXPECT_FALSE(pair.isFlawed) << pair.fibreId;
          for (int axis = 0; axis < 3; ++axis)
          {
            const auto lower = rimOf(pair.*kind, box, 2 * axis);
            const auto upper = rimOf(pair.*kind, box, 2 * axis + 1);
            if (axis < 2 || border == Border::Periodic)
            {
              EXPECT_EQ(lower, upper) << pair.fibreId << ' ' << axis;
            }
            points[std::size_t(axis)] += lower.size();
          }
        }
        EXPECT_GT(points[0], 200u);
        EXPECT_GT(points[1], 200u);
        EXPECT_GT(points[2], 200u);
      }
      const auto hasNodes = [](const FibreSurfacePair& pair) { return pair.nodes > 0; };
      EXPECT_EQ(std::any_of(pairs.begin(), pairs.end(), hasNodes), options.hasNodes());
      for (const FibreSurfacePair& pair : border == Border::Periodic ? pairs : std::vector<FibreSurfacePair>())
      {
        const TriangleMesh inner = openAtPeriodicFaces(pair.inner, tissue.fibres.domain);
        EXPECT_FALSE(meetsItself(inner)) << pair.fibreId;
        EXPECT_FALSE(surfacesMeet(inner, openAtPeriodicFaces(pair.outer, tissue.fibres.domain))) << pair.fibreId;
      }
    }
  }
}

/// In eight copies of the domain, side by side, walls without their caps are open nowhere but where all copies end.
TEST(PeriodicSurfaces, CopiesFitTogether)
{
  const PeriodicTissue tissue(Border::Periodic);
  const std::vector<FibreSurfacePair> pairs = tissue.surfaces({});
  const double half = 0.5 * tissue.fibres.domain.size().x();
  std::size_t inside = 0;
  std::size_t ridges = 0; // which touch a face from within
  for (const FibreSurfacePair& pair : pairs)
  {
    using Place = std::array<double, 3>;
    std::map<std::pair<Place, Place>, int> uses; // of edges, in their sense
    for (int copy = 0; copy < 8; ++copy)
    {
      const Eigen::Vector3d shift(2.0 * half * (copy & 1), 2.0 * half * (copy >> 1 & 1), 2.0 * half * (copy >> 2 & 1));
      for (const auto& t : pair.outer.triangles)
      {
        const auto at = [&](std::size_t i) -> const Eigen::Vector3d& { return pair.outer.points[std::size_t(t[i % 3])]; };
        bool isCap = false;
        for (int axis = 0; axis < 3; ++axis)
        {
          isCap = isCap || (std::abs(at(0)[axis]) == half && at(0)[axis] == at(1)[axis] && at(0)[axis] == at(2)[axis]);
        }
        for (std::size_t i = 0; i < 3 && !isCap; ++i)
        {
          const Eigen::Vector3d a = at(i) + shift;
          const Eigen::Vector3d b = at(i + 1) + shift;
          ++uses[{ Place{ { a.x(), a.y(), a.z() } }, Place{ { b.x(), b.y(), b.z() } } }];
        }
      }
    }
    for (const auto& [edge, count] : uses)
    {
      EXPECT_EQ(count, 1) << pair.fibreId;
      const auto back = uses.find({ edge.second, edge.first });
      bool isAtTheEnd = false;
      bool isBetween = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        isAtTheEnd =
          isAtTheEnd || (edge.first[axis] == edge.second[axis] && (edge.first[axis] == -half || edge.first[axis] == 3.0 * half));
        isBetween = isBetween || (edge.first[axis] == half && edge.second[axis] == half);
      }
      EXPECT_TRUE(back != uses.end() || isAtTheEnd)
        << pair.fibreId << ' ' << edge.first[0] << ' ' << edge.first[1] << ' ' << edge.first[2];
      ridges += isAtTheEnd && back != uses.end() ? 1 : 0;
      inside += isBetween && back != uses.end() ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 1000u);
  EXPECT_LE(ridges, 16u); // each counts eight times
}

TEST(PeriodicSurfaces, WhatWouldBreakTheRimsIsRefused)
{
  const PeriodicTissue tissue(Border::Periodic);
  MyelinSurfaceOptions options;
  options.minimumAngle = 10.0;
  EXPECT_THROW(tissue.surfaces(options), InvalidInput);
  options = {};
  options.clipToDomain = false;
  EXPECT_THROW(tissue.surfaces(options), InvalidInput);
  PeriodicTissue rough = tissue;
  rough.growth.surfaceRoughness = 0.1;
  EXPECT_THROW(rough.image(), InvalidInput);
  PeriodicTissue bent = tissue;
  bent.fibres.points[bent.fibres.offsets[1]].x() += 0.01;
  EXPECT_THROW(bent.image(), InvalidInput);
  const LabelImage wide = tissue.image(0.5);
  EXPECT_THROW(FibreField({ wide.grid, wide.fibreId.data(), wide.depth.data(), tissue.growth.gap() }, tissue.fibres.domain, true),
    InvalidInput);
}

} // namespace
