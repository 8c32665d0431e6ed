// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: the table has the content of a standard one, for any number of keys and any regularity among them.
#include "mesh/PointTable.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace
{

using cactus::PointTable;

TEST(PointTable, HoldsWhatAMapHolds)
{
  std::mt19937_64 engine(3);
  PointTable table;
  for (const std::uint64_t most : { std::uint64_t(300), std::uint64_t(1) << 40, ~std::uint64_t(1) })
  {
    std::uniform_int_distribution<std::uint64_t> keys(0, most);
    std::map<std::uint64_t, std::int32_t> known;
    for (int n = 0; n < 5000; ++n)
    {
      const std::uint64_t key = keys(engine);
      const auto found = known.find(key);
      std::int32_t& number = table[key];
      ASSERT_EQ(number, found != known.end() ? found->second : PointTable::none);
      number = known[key] = n;
    }
    table.clear();
    for (const auto& entry : known)
    {
      ASSERT_EQ(table[entry.first], PointTable::none);
    }
    table.clear();
  }
}

// Nodes of a lattice: keys that are multiples of each other, including large powers of two.
TEST(PointTable, TellsRegularKeysApart)
{
  for (const std::uint64_t step : { std::uint64_t(1), std::uint64_t(4), std::uint64_t(1) << 20, std::uint64_t(1) << 50 })
  {
    PointTable table;
    for (std::int32_t n = 0; n < 4000; ++n)
    {
      table[step * std::uint64_t(n)] = n;
    }
    for (std::int32_t n = 0; n < 4000; ++n)
    {
      ASSERT_EQ(table[step * std::uint64_t(n)], n);
    }
  }
}

} // namespace
