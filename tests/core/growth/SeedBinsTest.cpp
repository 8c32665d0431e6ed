// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: seeds and their bins are the same on any number of threads, in the same order, and a search in the bins misses no
// piece.
#include "growth/SeedBins.h"

#include "GrowthExamples.h"
#include "base/Random.h"
#include "growth/CapsuleSeeds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

namespace
{

using namespace cactus;

/// Wavy fibres through a cube of 20 µm and out of it, numbered backwards.
Fibres wavyFibres(int count)
{
  Fibres fibres = cactus_testing::emptyFibres(20.0);
  RandomEngine engine = randomStream(1, RandomStage::Seeds, 0);
  const auto among = [&](double lower, double upper) { return lower + (upper - lower) * uniform(engine); };
  for (int f = 0; f < count; ++f)
  {
    const double radius = among(0.3, 1.5);
    fibres.addFibre(count - f, 1, radius);
    const Eigen::Vector3d start(among(-10.0, 10.0), among(-10.0, 10.0), -15.0);
    const double phase = among(0.0, 6.0);
    for (int p = 0; p <= 15; ++p)
    {
      fibres.addPoint(start + Eigen::Vector3d(std::sin(phase + p), std::cos(phase + 0.7 * p), 2.0 * p), radius);
    }
  }
  return fibres;
}

CapsuleSeeds seedsOf(const Fibres& fibres, int threads)
{
  return { fibres, SeedOptions{ 0.2, 1 }, Eigen::AlignedBox3d(fibres.domain.lower, fibres.domain.upper), 1.0, threads };
}

std::vector<std::uint32_t> foundNear(const SeedBins& bins, const Eigen::AlignedBox3d& box)
{
  std::vector<std::uint32_t> found;
  bins.forEachNear(box.min(), box.max(), [&](std::uint32_t piece) { found.push_back(piece); });
  return found;
}

TEST(CapsuleSeeds, AreTheSameOnAnyNumberOfThreads)
{
  const Fibres fibres = wavyFibres(50); // more than a thread takes at a time
  const CapsuleSeeds one = seedsOf(fibres, 1);
  EXPECT_GT(one.pieces.size(), 1000u);
  EXPECT_EQ(one.pieceOffsets.front(), 0u);
  EXPECT_EQ(one.pieceOffsets.back(), one.pieces.size());
  for (const int threads : { 2, 3, 20 })
  {
    const CapsuleSeeds many = seedsOf(fibres, threads);
    EXPECT_EQ(many.fibreOfRank, one.fibreOfRank);
    EXPECT_EQ(many.pieceOffsets, one.pieceOffsets);
    ASSERT_EQ(many.pieces.size(), one.pieces.size());
    for (std::size_t p = 0; p < one.pieces.size(); ++p)
    {
      const Cone& a = one.pieces[p].cone;
      const Cone& b = many.pieces[p].cone;
      ASSERT_TRUE(a.start == b.start && a.axis == b.axis && a.length == b.length && a.radius == b.radius && a.slope == b.slope);
      ASSERT_EQ(many.pieces[p].rank, one.pieces[p].rank);
    }
  }
}

TEST(SeedBins, FindAllThatIsNearInOneOrderOnAnyNumberOfThreads)
{
  const CapsuleSeeds seeds = seedsOf(wavyFibres(50), 1);
  const SeedBins one(seeds.pieces, 1);
  RandomEngine engine = randomStream(2, RandomStage::Seeds, 0);
  for (const int threads : { 2, 3, 20 })
  {
    const SeedBins many(seeds.pieces, threads);
    for (int n = 0; n < 50; ++n)
    {
      Eigen::AlignedBox3d box;
      for (int corner = 0; corner < 2; ++corner)
      {
        box.extend(20.0 * Eigen::Vector3d(uniform(engine) - 0.5, uniform(engine) - 0.5, uniform(engine) - 0.5));
      }
      const std::vector<std::uint32_t> found = foundNear(one, box);
      EXPECT_EQ(foundNear(many, box), found);
      const std::set<std::uint32_t> distinct(found.begin(), found.end());
      for (std::size_t p = 0; p < seeds.pieces.size(); ++p)
      {
        EXPECT_TRUE(!boundingBox(seeds.pieces[p].cone).intersects(box) || distinct.count(std::uint32_t(p)) == 1);
      }
    }
  }
}

TEST(SeedBins, OfNothingFindNothing)
{
  for (const int threads : { 1, 4 })
  {
    EXPECT_TRUE(foundNear(SeedBins({}, threads), { Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones() }).empty());
  }
}

} // namespace
