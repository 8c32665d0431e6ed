// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Limits.h"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cactus
{

/// A quantity that fibres may have, one number each.
struct ColumnFacts
{
  const char* name;    ///< of the column, and of the array in files and in VTK
  const char* meaning; ///< for a reader of the documentation
  Range range;         ///< of the values
};

/// Ratio of the axon's diameter to the fibre's that a fibre is to have, instead of the one that MyelinSurface gives all others. A
/// fibre of 1 is an axon without myelin.
inline constexpr ColumnFacts targetGRatioColumn{ "TargetGRatio", "g-ratio that the fibre's surfaces are to have; 1: no myelin",
  limits::gRatioOrBare };
/// The g-ratio of an axon without myelin. One surface bounds it: its outer surface and its inner one are the same, bit for bit.
inline constexpr double bareGRatio = limits::gRatioOrBare.highest;

/// Mean axis ratio that the sections of a fibre's axon are to have, see SectionShape.
inline constexpr ColumnFacts targetAxisRatioColumn{ "TargetAxisRatio",
  "minor over major axis that sections of the fibre's axon are to have; 1: growth alone shapes them", limits::sectionAxisRatio };

/// Returns the columns that stages pass on from fibres to fibres, by name.
const std::vector<ColumnFacts>& fibreColumns();

class ColumnTable;

/// Throws InvalidInput, naming `fibre` and the column, for a value of this row outside the column's range.
void validateRow(const ColumnTable& columns, std::size_t row, const std::string& fibre);

/// Named columns of numbers with one row per fibre. A value that was never given is NaN, and a column may end before the last
/// row.
class ColumnTable
{
public:
  using Columns = std::map<std::string, std::vector<double>, std::less<>>;

  bool isEmpty() const { return this->Values.empty(); }
  /// Returns all columns, by name.
  const Columns& all() const { return this->Values; }
  /// Returns NaN if the row has no such value.
  double value(std::string_view column, std::size_t row) const;
  void set(std::string_view column, std::size_t row, double value);
  /// Sets all values of a row to those of a row of another table.
  void copyRow(const ColumnTable& from, std::size_t fromRow, std::size_t row);

private:
  Columns Values;
};

} // namespace cactus
