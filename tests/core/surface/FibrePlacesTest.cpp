// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: an image that is computed on demand gives the same results as the whole image, fibre by fibre.
#include "surface/FibrePlaces.h"

#include "growth/GrownTiles.h"
#include "surface/MeetingFibres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace
{

using namespace cactus;

void expectSame(const FoundFibre& one, const FoundFibre& other)
{
  EXPECT_EQ(one.depths, other.depths);
  EXPECT_EQ(one.samples, other.samples);
  EXPECT_TRUE(std::equal(one.boxes.begin(), one.boxes.end(), other.boxes.begin(), other.boxes.end(),
    [](const FoundBox& a, const FoundBox& b) { return a.piece == b.piece && a.ends == b.ends; }));
}

/// Three fibres that meet, with different targets, and one elsewhere.
Fibres fibresOfTargets()
{
  Fibres fibres = example::fibresThatMeet();
  fibres.targetRadii = { 0.4, 0.5, 0.7 };
  fibres.addFibre(5, 1, 0.1);
  fibres.addPoint({ 25.0, 25.0, -2.0 }, 0.1);
  fibres.addPoint({ 25.0, 25.0, 2.0 }, 0.1);
  return fibres;
}

TEST(FibrePlaces, AreThoseOfTheWholeImage)
{
  FibreRadialGrowthOptions growth;
  growth.voxelSize = 0.05;
  const Fibres fibres = fibresOfTargets();
  const LabelImage image = growFibres(fibres, growth, 0.3, growthGrid(fibres.domain, growth));
  const LabelImageView view{ image.grid, image.fibreId.data(), image.depth.data(), growth.gap() };
  const LabelImageFacts facts = labelImageFacts(fibres, growth);
  Domain part = Domain::cube(3.0);
  part.lower[1] += 0.4;
  part.upper[2] -= 0.5;
  for (const Domain& domain : { Domain::cube(3.0), part })
  {
    const FibreField whole(view, domain, true);
    const FibreField computed(std::make_shared<GrownTiles>(fibres, growth, 0.3, 20), domain, true);
    const FibrePlaces wanted(whole, facts);
    const FibrePlaces places(computed, facts);
    EXPECT_EQ(wanted.all().size(), 3u);
    for (const std::int32_t id : { 1, 2, 3, 4, 5 })
    {
      expectSame(places.find(id), wanted.find(id));
      EXPECT_EQ(places.find(id).samples > 0.0, id <= 3);
    }
    for (const std::int32_t id : { 1, 2, 3 })
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(places.all().at(id).middle[axis], wanted.all().at(id).middle[axis], 1);
      }
      EXPECT_GT(places.all().at(id).size, 0.0);
    }
    // None, few, most, and all.
    for (const double radius : { 0.05, 0.45, 0.6, 1.0 })
    {
      const FoundFibres thin = places.thinnerThan(radius);
      const FoundFibres wantedThin = wanted.thinnerThan(radius);
      ASSERT_EQ(thin.size(), wantedThin.size());
      EXPECT_EQ(thin.size(), radius < 0.1 ? 0u : radius < 0.5 ? 1u : radius < 0.7 ? 2u : 3u);
      for (const auto& [id, fibre] : thin)
      {
        expectSame(fibre, wantedThin.at(id));
      }
    }
    LabelImageFacts nothingKnown = facts;
    nothingKnown.targetRadii = { 0.0, 0.0, 0.7, 0.7 };
    EXPECT_EQ(FibrePlaces(whole, nothingKnown).thinnerThan(0.05).size(), 2u); // any may be thin
  }
}

} // namespace
