// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: gaps, meetings and nesting are those found by comparing all pairs, however few surfaces are kept in memory.
#include "judge/FibreGaps.h"

#include "ExampleSurfaces.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/SurfacePieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>

namespace
{

using cactus::FibreCertificate;
using cactus::OuterSurfaces;
using cactus::SubstrateCertificate;
using cactus::TreedSurface;
using cactus::TriangleMesh;
using Eigen::Vector3d;

/// Returns the findings with about so many bytes of surfaces in memory; counts how many surfaces are made.
SubstrateCertificate findingsOf(const std::vector<TriangleMesh>& surfaces, std::size_t bytes, std::size_t& made, int threads = 1)
{
  std::atomic<std::size_t> count{ 0 };
  const auto make = [&](std::size_t place)
  {
    ++count;
    return std::make_shared<const TreedSurface>(surfaces[place]);
  };
  SubstrateCertificate certificate;
  OuterSurfaces outer(surfaces.size(), bytes, make);
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    FibreCertificate fibre;
    fibre.fibreId = static_cast<int>(i) + 1;
    fibre.gap = std::numeric_limits<double>::quiet_NaN();
    fibre.outer = cactus::checkSurface(surfaces[i]);
    certificate.fibres.push_back(fibre);
    outer.enter(i, make(i));
  }
  cactus::Context context;
  context.threads = threads;
  findGaps(cactus::Domain(), outer, certificate, context, 0.0);
  made = count;
  return certificate;
}

/// Computes the same from all pairs.
SubstrateCertificate byAllPairs(const std::vector<TriangleMesh>& surfaces)
{
  SubstrateCertificate certificate;
  certificate.smallestGap = std::numeric_limits<double>::infinity();
  certificate.fibres.resize(surfaces.size());
  for (FibreCertificate& fibre : certificate.fibres)
  {
    fibre.gap = std::numeric_limits<double>::infinity();
  }
  for (std::size_t a = 0; a < surfaces.size(); ++a)
  {
    const TreedSurface one(surfaces[a]);
    for (std::size_t b = a + 1; b < surfaces.size(); ++b)
    {
      const TreedSurface other(surfaces[b]);
      const double gap = smallestGap(one.tree, other.tree).distance;
      const bool nested = gap > 0.0 && (anyLiesInside(one.mesh, cactus::checkSurface(one.mesh), other.tree) ||
                                         anyLiesInside(other.mesh, cactus::checkSurface(other.mesh), one.tree));
      certificate.meetingPairs += gap == 0.0 ? 1 : 0;
      certificate.nestedPairs += nested ? 1 : 0;
      certificate.smallestGap = std::min(certificate.smallestGap, gap);
      for (const auto& [own, neighbour] : { std::pair(a, b), std::pair(b, a) })
      {
        FibreCertificate& fibre = certificate.fibres[own];
        fibre.meetingFibres += gap == 0.0 || nested ? 1 : 0;
        if (gap < fibre.gap)
        {
          fibre.gap = gap;
          fibre.nearestFibre = static_cast<int>(neighbour) + 1;
        }
      }
    }
  }
  return certificate;
}

void expectSame(const SubstrateCertificate& found, const SubstrateCertificate& expected)
{
  EXPECT_EQ(found.smallestGap, expected.smallestGap);
  EXPECT_EQ(found.meetingPairs, expected.meetingPairs);
  EXPECT_EQ(found.nestedPairs, expected.nestedPairs);
  ASSERT_EQ(found.fibres.size(), expected.fibres.size());
  for (std::size_t f = 0; f < found.fibres.size(); ++f)
  {
    EXPECT_EQ(found.fibres[f].gap, expected.fibres[f].gap) << f;
    EXPECT_EQ(found.fibres[f].nearestFibre, expected.fibres[f].nearestFibre) << f;
    EXPECT_EQ(found.fibres[f].meetingFibres, expected.fibres[f].meetingFibres) << f;
  }
}

/// Makes tubes of different lengths, some of which meet, contain each other or are far from all others.
std::vector<TriangleMesh> someTubes(unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<TriangleMesh> surfaces;
  for (int i = 0; i < 24; ++i)
  {
    const double radius = 0.1 + 0.8 * uniform(random) * uniform(random);
    const double x = 9.0 * uniform(random);
    const double y = 9.0 * uniform(random);
    const double lower = -6.0 * uniform(random);
    if (i % 6 == 0)
    {
      surfaces.push_back(example::tube(x, y, 0.5 * radius, lower + 0.05, lower + 0.15, 12, 5));
    }
    surfaces.push_back(example::tube(x, y, radius, lower, lower + 0.2 + 6.0 * uniform(random), 12, 20, 0.02, seed + unsigned(i)));
  }
  surfaces.push_back(example::tube(200.0, 5.0, 0.5, -1.0, 1.0));
  surfaces.push_back({});
  return surfaces;
}

} // namespace

TEST(FibreGaps, AreThoseOfAllPairs)
{
  std::size_t meeting = 0;
  std::size_t nested = 0;
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    const std::vector<TriangleMesh> surfaces = someTubes(seed);
    std::vector<TriangleMesh> present(surfaces.begin(), surfaces.end() - 1);
    SubstrateCertificate expected = byAllPairs(present);
    expected.fibres.emplace_back();
    expected.fibres.back().gap = std::numeric_limits<double>::quiet_NaN();
    std::size_t made = 0;
    SubstrateCertificate found = findingsOf(surfaces, std::size_t(1) << 30, made);
    EXPECT_TRUE(std::isnan(found.fibres.back().gap)) << "has no surface";
    found.fibres.back().gap = expected.fibres.back().gap = 0.0;
    EXPECT_EQ(made, surfaces.size());
    expectSame(found, expected);
    meeting += expected.meetingPairs;
    nested += expected.nestedPairs;
  }
  EXPECT_GT(meeting, 10u);
  EXPECT_GT(nested, 3u);
}

TEST(FibreGaps, AreTheSameHoweverFewSurfacesAreKeptOnSeveralThreads)
{
  const std::vector<TriangleMesh> surfaces = someTubes(9);
  std::size_t made = 0;
  const SubstrateCertificate expected = findingsOf(surfaces, std::size_t(1) << 30, made);
  for (const int threads : { 1, 4 })
  {
    SubstrateCertificate found = findingsOf(surfaces, 1, made, threads);
    EXPECT_GT(made, 2 * surfaces.size());
    found.fibres.back().gap = 0.0;
    SubstrateCertificate same = expected;
    same.fibres.back().gap = 0.0;
    expectSame(found, same);
  }
}

// Two tubes in a wide hollow one are nearer to each other than to the one around them.
TEST(FibreGaps, FindWhatHoldsFibresFarFromItsWalls)
{
  const std::vector<TriangleMesh> surfaces{ example::tube(0, 0, 5.0, -50.0, 50.0, 48, 400),
    example::tube(-0.2, 0, 0.1, -0.5, 0.5), example::tube(0.2, 0, 0.1, -0.5, 0.5), example::tube(20.0, 0, 1.0, -50.0, 50.0) };
  std::size_t made = 0;
  const SubstrateCertificate found = findingsOf(surfaces, std::size_t(1) << 30, made);
  EXPECT_EQ(found.nestedPairs, 2u);
  EXPECT_EQ(found.meetingPairs, 0u);
  EXPECT_EQ(found.fibres[0].meetingFibres, 2u);
  EXPECT_EQ(found.fibres[3].meetingFibres, 0u);
  EXPECT_NEAR(found.smallestGap, 0.2, 1e-12);
}

TEST(FibreGaps, OfOneFibreThereAreNone)
{
  std::size_t made = 0;
  EXPECT_TRUE(std::isnan(findingsOf({ example::tube(0, 0, 1.0, -1.0, 1.0) }, 1, made).smallestGap));
  EXPECT_TRUE(std::isnan(findingsOf({}, 1, made).smallestGap));
}
