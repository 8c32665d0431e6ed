// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/BorderRuns.h"

#include "base/Bytes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace cactus
{

namespace
{

/// Largest number of cells: a set of them needs a bit for each.
constexpr double mostCells = 8e6;

/// The grid that all processes share, with cells half as large as a box along each axis, so that two boxes with a common cell are
/// close to each other.
class CoarseGrid
{
public:
  CoarseGrid(const std::vector<RunBox>& boxes, const Sharing& sharing)
  {
    ByteWriter mine;
    mine(static_cast<std::uint64_t>(boxes.size()));
    for (int axis = 0; axis < 3; ++axis)
    {
      float lower = std::numeric_limits<float>::infinity();
      float upper = -lower;
      double extent = 0.0;
      for (const RunBox& box : boxes)
      {
        lower = std::min(lower, box.lower[axis]);
        upper = std::max(upper, box.upper[axis]);
        extent += box.upper[axis] - box.lower[axis];
      }
      mine(lower);
      mine(upper);
      mine(extent);
    }
    this->join(sharing.exchange(mine.bytes()));
  }

  std::size_t size() const { return this->Count[0] * this->Count[1] * this->Count[2]; }

  /// Calls visit(cell) for each cell that the box touches, until it returns false.
  template <typename Visit>
  void forEachCell(const RunBox& box, Visit&& visit) const
  {
    std::size_t first[3];
    std::size_t last[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = this->cellOf(box.lower[axis], axis);
      last[axis] = this->cellOf(box.upper[axis], axis);
    }
    for (std::size_t z = first[2]; z <= last[2]; ++z)
    {
      for (std::size_t y = first[1]; y <= last[1]; ++y)
      {
        for (std::size_t x = first[0]; x <= last[0]; ++x)
        {
          if (!visit(x + this->Count[0] * (y + this->Count[1] * z)))
          {
            return;
          }
        }
      }
    }
  }

private:
  void join(const std::vector<std::string>& told)
  {
    double boxes = 0.0;
    float lower[3];
    float upper[3];
    double extent[3] = {};
    std::fill_n(lower, 3, std::numeric_limits<float>::infinity());
    std::fill_n(upper, 3, -std::numeric_limits<float>::infinity());
    for (const std::string& bytes : told)
    {
      ByteReader get(bytes);
      boxes += static_cast<double>(get.get<std::uint64_t>());
      for (int axis = 0; axis < 3; ++axis)
      {
        lower[axis] = std::min(lower[axis], get.get<float>());
        upper[axis] = std::max(upper[axis], get.get<float>());
        extent[axis] += get.get<double>();
      }
    }
    double cells = 1.0;
    double wanted[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      wanted[axis] = std::max(1.0, 2.0 * (double(upper[axis]) - lower[axis]) * boxes / std::max(extent[axis], 1e-30));
      cells *= wanted[axis];
    }
    const double coarser = std::cbrt(std::max(1.0, cells / mostCells));
    for (int axis = 0; axis < 3; ++axis)
    {
      // A long and thin bundle may have more than its share along one axis, but never more than the limit in all.
      const double count = std::clamp(std::floor(wanted[axis] / coarser), 1.0, std::cbrt(mostCells) * 4.0);
      this->Count[axis] = static_cast<std::size_t>(count);
      this->Lower[axis] = lower[axis];
      this->InverseSize[axis] = static_cast<float>(count / std::max(double(upper[axis]) - lower[axis], 1e-30));
    }
  }

  /// Monotonic in the coordinate.
  std::size_t cellOf(float position, int axis) const
  {
    const float cell = (position - this->Lower[axis]) * this->InverseSize[axis];
    return std::min(static_cast<std::size_t>(std::max(cell, 0.0f)), this->Count[axis] - 1);
  }

  float Lower[3];
  float InverseSize[3];
  std::size_t Count[3];
};

/// A set of the grid's cells.
class CellSet
{
public:
  explicit CellSet(std::size_t cells)
    : Bits((cells + 7) / 8, '\0')
  {
  }
  explicit CellSet(std::string bits)
    : Bits(std::move(bits))
  {
  }

  void add(std::size_t cell) { this->Bits[cell / 8] = static_cast<char>(this->Bits[cell / 8] | (1 << cell % 8)); }
  bool has(std::size_t cell) const { return (this->Bits[cell / 8] >> cell % 8 & 1) != 0; }
  const std::string& bits() const { return this->Bits; }

private:
  std::string Bits;
};

bool reaches(const RunBox& box, const CoarseGrid& grid, const CellSet& cells)
{
  bool found = false;
  grid.forEachCell(box,
    [&](std::size_t cell)
    {
      found = cells.has(cell);
      return !found;
    });
  return found;
}

} // namespace

std::vector<std::vector<std::size_t>> boxesNearOthers(const std::vector<RunBox>& boxes, const Sharing& sharing)
{
  const CoarseGrid grid(boxes, sharing);
  CellSet own(grid.size());
  for (const RunBox& box : boxes)
  {
    grid.forEachCell(box,
      [&](std::size_t cell)
      {
        own.add(cell);
        return true;
      });
  }
  std::vector<std::string> told = sharing.exchange(own.bits());
  const auto self = static_cast<std::size_t>(sharing.place());
  // Most boxes are near no other process's.
  std::string anybody(told[self].size(), '\0');
  for (std::size_t process = 0; process < told.size(); ++process)
  {
    for (std::size_t i = 0; i < anybody.size() && process != self; ++i)
    {
      anybody[i] = static_cast<char>(anybody[i] | told[process][i]);
    }
  }
  const CellSet others(std::move(anybody));
  std::vector<CellSet> cells;
  cells.reserve(told.size());
  for (std::string& bits : told)
  {
    cells.emplace_back(std::move(bits));
  }
  std::vector<std::vector<std::size_t>> near(cells.size());
  for (std::size_t box = 0; box < boxes.size(); ++box)
  {
    if (!reaches(boxes[box], grid, others))
    {
      continue;
    }
    for (std::size_t process = 0; process < cells.size(); ++process)
    {
      if (process != self && reaches(boxes[box], grid, cells[process]))
      {
        near[process].push_back(box);
      }
    }
  }
  return near;
}

} // namespace cactus
