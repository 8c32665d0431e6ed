// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/ColumnTable.h"

#include "base/Error.h"

#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

constexpr double none = std::numeric_limits<double>::quiet_NaN();

} // namespace

const std::vector<ColumnFacts>& fibreColumns()
{
  static const std::vector<ColumnFacts> columns{ targetAxisRatioColumn, targetGRatioColumn };
  return columns;
}

void validateRow(const ColumnTable& columns, std::size_t row, const std::string& fibre)
{
  for (const ColumnFacts& column : fibreColumns())
  {
    // A file in single precision may have rounded the lowest value down.
    constexpr double rounding = 1e-6;
    const double given = columns.value(column.name, row);
    const double value = std::abs(given - column.range.lowest) < rounding ? column.range.lowest : given;
    if (!std::isnan(value))
    {
      requireWithin((fibre + ": " + column.name).c_str(), value, column.range);
    }
  }
}

double ColumnTable::value(std::string_view column, std::size_t row) const
{
  const auto found = this->Values.find(column);
  return found != this->Values.end() && row < found->second.size() ? found->second[row] : none;
}

void ColumnTable::set(std::string_view column, std::size_t row, double value)
{
  auto found = this->Values.find(column);
  if (found == this->Values.end())
  {
    if (std::isnan(value))
    {
      return;
    }
    found = this->Values.emplace(column, std::vector<double>()).first;
  }
  std::vector<double>& values = found->second;
  if (row >= values.size())
  {
    values.resize(row + 1, none);
  }
  values[row] = value;
}

void ColumnTable::copyRow(const ColumnTable& from, std::size_t fromRow, std::size_t row)
{
  for (auto& [name, values] : this->Values)
  {
    if (row < values.size())
    {
      values[row] = none;
    }
  }
  for (const auto& [name, values] : from.Values)
  {
    this->set(name, row, from.value(name, fromRow));
  }
}

} // namespace cactus
