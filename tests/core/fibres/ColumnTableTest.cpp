// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: what is known of a fibre stays with it wherever fibres are selected, joined, trimmed, resampled or reordered.
#include "fibres/ColumnTable.h"
#include "base/Error.h"
#include "fibres/FibreOrder.h"
#include "fibres/JoinFibres.h"
#include "fibres/ResampledFibres.h"
#include "fibres/SelectFibres.h"
#include "fibres/TrimToDomain.h"
#include "optimiser/CoarseFibres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{

using namespace cactus;

constexpr const char* column = targetGRatioColumn.name;

/// Fibres along z, one µm apart; those with a value have 0.6 plus a hundredth of their id.
Fibres fibresWith(const std::vector<int>& ids, const std::vector<int>& withValue)
{
  Fibres fibres;
  fibres.domain = Domain::cube(6.0);
  for (const int id : ids)
  {
    fibres.addFibre(id, 1, 0.3);
    for (int i = 0; i <= 8; ++i)
    {
      fibres.addPoint({ static_cast<double>(id) - 3.0, 0.0, static_cast<double>(i) - 4.0 }, 0.3);
    }
  }
  for (const int id : withValue)
  {
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      if (fibres.fibreIds[f] == id)
      {
        fibres.columns.set(column, f, 0.6 + 0.01 * id);
      }
    }
  }
  return fibres;
}

void expectValues(const Fibres& fibres, const std::vector<int>& idsWithValue)
{
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const int id = fibres.fibreIds[f];
    const bool isGiven = std::find(idsWithValue.begin(), idsWithValue.end(), id) != idsWithValue.end();
    const double value = fibres.columns.value(column, f);
    EXPECT_EQ(std::isnan(value), !isGiven) << id;
    EXPECT_TRUE(!isGiven || value == 0.6 + 0.01 * id) << id;
  }
}

TEST(ColumnTable, RowsWithoutAValueAreNaN)
{
  ColumnTable table;
  EXPECT_TRUE(std::isnan(table.value("A", 3)));
  table.set("A", 2, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(table.isEmpty());
  table.set("A", 2, 5.0);
  EXPECT_TRUE(std::isnan(table.value("A", 1)));
  EXPECT_TRUE(std::isnan(table.value("A", 3)));
  EXPECT_EQ(table.value("A", 2), 5.0);
  ColumnTable other;
  other.set("B", 0, 1.0);
  table.copyRow(other, 0, 2);
  EXPECT_TRUE(std::isnan(table.value("A", 2)));
  EXPECT_EQ(table.value("B", 2), 1.0);
}

TEST(ColumnTable, StaysWithItsFibres)
{
  const Fibres fibres = fibresWith({ 1, 2, 3, 4 }, { 2, 4 });
  expectValues(selectFibres(fibres, { 3, 0, 1 }), { 2, 4 });
  expectValues(FibreOrder(fibres).ordered(fibres), { 2, 4 });
  expectValues(trimToDomain(fibres), { 2, 4 });
  expectValues(CoarseFibres(fibres).fibres(), { 2, 4 });

  Fibres joined = fibresWith({ 1 }, {});
  appendFibres(fibresWith({ 2, 3 }, { 3 }), joined);
  appendFibres(fibresWith({ 5 }, {}), joined);
  expectValues(joined, { 3 });

  Fibres dense = fibresWith({ 1, 2, 3 }, { 3 });
  for (double& radius : dense.radii)
  {
    radius = 2.4;
  }
  EXPECT_EQ(resampleDenseFibres(dense).fibres, 3u);
  expectValues(dense, { 3 });
}

TEST(ColumnTable, PiecesOfAFibreAreLikeIt)
{
  Fibres fibres;
  fibres.domain = Domain::cube(4.0);
  fibres.addFibre(1, 1, 0.3);
  for (const double x : { 0.0, 3.0, 6.0 })
  {
    fibres.addPoint({ x, 0.0, -1.0 }, 0.3);
  }
  for (const double x : { 6.0, 3.0, 0.0 })
  {
    fibres.addPoint({ x, 0.0, 1.0 }, 0.3);
  }
  fibres.columns.set(column, 0, 0.8);
  const Fibres pieces = trimToDomain(fibres);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces.columns.value(column, 0), 0.8);
  EXPECT_EQ(pieces.columns.value(column, 1), 0.8);
}

TEST(ColumnTable, ValuesOutOfRangeAreNamed)
{
  Fibres fibres = fibresWith({ 1, 2 }, {});
  fibres.columns.set(column, 1, 1.2);
  try
  {
    validate(fibres);
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("TargetGRatio is 1.2"), std::string::npos) << error.what();
  }
}

} // namespace

TEST(ColumnTable, LowestValuesMayComeFromSinglePrecision)
{
  ColumnTable table;
  table.set("TargetAxisRatio", 0, double(0.7f));
  table.set("TargetAxisRatio", 1, 0.69);
  EXPECT_NO_THROW(cactus::validateRow(table, 0, "fibre 1"));
  EXPECT_THROW(cactus::validateRow(table, 1, "fibre 2"), cactus::InvalidInput);
}
