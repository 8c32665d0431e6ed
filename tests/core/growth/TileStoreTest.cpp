// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: no more tiles are kept than the limit, the most recently used before others, and their memory is used again.
#include "growth/TileStore.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace
{

using cactus::Tile;
using cactus::TileStore;

/// Keeps a tile that knows its number.
void keep(TileStore& store, std::uint64_t number)
{
  const std::shared_ptr<Tile> tile = store.make();
  tile->fibreId[0] = std::int32_t(number);
  store.keep(number, tile);
}

TEST(TileStore, KeepsThoseUsedLast)
{
  TileStore store(2);
  keep(store, 0);
  keep(store, 7);
  EXPECT_EQ(store.find(0)->fibreId[0], 0);
  keep(store, 9); // 7 was used before 0
  EXPECT_EQ(store.find(7), nullptr);
  EXPECT_EQ(store.find(0)->fibreId[0], 0);
  EXPECT_EQ(store.find(9)->fibreId[0], 9);
  const std::shared_ptr<Tile> other = store.make();
  other->fibreId[0] = 99;
  store.keep(9, other); // too late
  EXPECT_EQ(store.find(9)->fibreId[0], 9);
}

TEST(TileStore, KeepsAllThatFollowOneAnother)
{
  for (const std::size_t most : { 1, 15, 16, 100, 5000 })
  {
    TileStore store(most);
    const auto count = std::uint64_t(most < 32 ? most : most - most / 4); // the number of sets is a prime
    for (std::uint64_t number = 0; number < count; ++number)
    {
      keep(store, 1000000 + number);
    }
    for (std::uint64_t number = 0; number < count; ++number)
    {
      ASSERT_NE(store.find(1000000 + number), nullptr) << most << ' ' << number;
    }
  }
}

TEST(TileStore, UsesRoomAgainThatNobodyNeeds)
{
  std::shared_ptr<const Tile> first;
  {
    TileStore store(100);
    keep(store, 0);
    first = store.find(0);
    std::size_t kept = 0;
    for (std::uint64_t number = 1; number < 10000; ++number)
    {
      keep(store, number);
    }
    for (std::uint64_t number = 0; number < 10000; ++number)
    {
      kept += store.find(number) != nullptr ? 1 : 0;
    }
    EXPECT_LE(kept, 100u);
    EXPECT_GE(kept, 80u);
    EXPECT_LE(store.rooms(), 256u);
    EXPECT_EQ(store.find(0), nullptr);
  }
  EXPECT_EQ(first->fibreId[0], 0); // a held tile stays, whatever happens to the store
}

} // namespace
