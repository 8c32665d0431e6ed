// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: fibres of several inputs keep their ids if these are free, else get others, and lose none of their points.
#include "fibres/JoinFibres.h"
#include "base/Error.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace
{

using cactus::Fibres;

Fibres fibresWith(const std::vector<std::pair<int, int>>& ids)
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(4.0);
  for (const auto& [fibre, bundle] : ids)
  {
    fibres.addFibre(fibre, bundle, 0.1 * fibre);
    fibres.addPoint({ 0.5 * fibre, 0.0, -1.0 }, 0.2);
    fibres.addPoint({ 0.5 * fibre, 0.0, 1.0 }, 0.3);
  }
  return fibres;
}

TEST(JoinFibres, FreeIdsStay)
{
  Fibres all = fibresWith({ { 1, 1 }, { 4, 1 } });
  appendFibres(fibresWith({ { 3, 2 }, { 2, 5 } }), all);
  EXPECT_EQ(all.fibreIds, (std::vector<int>{ 1, 4, 3, 2 }));
  EXPECT_EQ(all.bundleIds, (std::vector<int>{ 1, 1, 2, 5 }));
  EXPECT_EQ(all.offsets, (std::vector<std::size_t>{ 0, 2, 4, 6, 8 }));
  EXPECT_EQ(all.points[5], Eigen::Vector3d(1.5, 0.0, 1.0));
  EXPECT_EQ(all.radii[7], 0.3);
  EXPECT_EQ(all.targetRadii[2], 0.1 * 3);
}

TEST(JoinFibres, IdsInUseMoveTogether)
{
  Fibres all = fibresWith({ { 1, 1 }, { 7, 3 } });
  appendFibres(fibresWith({ { 2, 3 }, { 7, 4 } }), all);
  EXPECT_EQ(all.fibreIds, (std::vector<int>{ 1, 7, 9, 14 }));
  EXPECT_EQ(all.bundleIds, (std::vector<int>{ 1, 3, 6, 7 }));
}

TEST(JoinFibres, WhatTheyWereMadeForAddsUpWhereAllSaySo)
{
  Fibres all = fibresWith({ { 1, 1 } });
  all.grownFraction = 0.3;
  all.orientationHarmonics = { 0.3 };
  Fibres added = fibresWith({ { 2, 2 } });
  added.grownFraction = 0.25;
  added.orientationHarmonics = { 0.2, 0.1, 0.0, 0.2, 0.0, 0.0 };
  appendFibres(added, all);
  EXPECT_DOUBLE_EQ(all.grownFraction, 0.55);
  EXPECT_EQ(all.orientationHarmonics, (std::vector<double>{ 0.5, 0.1, 0.0, 0.2, 0.0, 0.0 })) << "the sum";
  appendFibres(fibresWith({ { 3, 3 } }), all);
  EXPECT_EQ(all.grownFraction, 0.0);
  EXPECT_TRUE(all.orientationHarmonics.empty());
}

TEST(JoinFibres, PiecesOfOneSubstrateAreForWhatEachSays)
{
  Fibres all = fibresWith({ { 1, 1 } });
  all.grownFraction = 0.6;
  all.orientationHarmonics = { 0.2 };
  for (const int id : { 2, 3 })
  {
    Fibres piece = fibresWith({ { id, 1 } });
    piece.grownFraction = 0.6;
    piece.orientationHarmonics = { id == 2 ? 0.2 : 0.3 };
    appendFibres(piece, all);
    EXPECT_EQ(all.grownFraction, 0.6);
    EXPECT_EQ(all.orientationHarmonics.size(), id == 2 ? 1U : 0U) << "none where pieces differ";
  }
  // Another bundle counts its fibres from 1, too.
  Fibres bundle = fibresWith({ { 1, 1 } });
  bundle.grownFraction = 0.6;
  appendFibres(bundle, all);
  EXPECT_DOUBLE_EQ(all.grownFraction, 1.2);
}

TEST(JoinFibres, RefusesWhereNoIdIsFree)
{
  constexpr int largest = std::numeric_limits<int>::max();
  Fibres all = fibresWith({ { largest, 1 } });
  EXPECT_THROW(appendFibres(fibresWith({ { largest, 2 } }), all), cactus::InvalidInput);
}

TEST(JoinFibres, TellsDomainsApart)
{
  cactus::Domain domain = cactus::Domain::cube(4.0);
  EXPECT_TRUE(isSame(domain, cactus::Domain::cube(4.0)));
  domain.upper[1] += 1e-6;
  EXPECT_FALSE(isSame(domain, cactus::Domain::cube(4.0)));
}

} // namespace
