// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/RunGrid.h"

#include "base/Memory.h"
#include "base/Parallel.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

constexpr std::size_t cellsTogether = 4096;

} // namespace

RunGrid::RunGrid(const std::vector<RunBox>& runs)
{
  RunBox all = runs.front();
  double extent[3] = {};
  for (const RunBox& run : runs)
  {
    extend(all, run);
    const Eigen::Array4f size = run.upper - run.lower;
    for (int axis = 0; axis < 3; ++axis)
    {
      extent[axis] += size[axis];
    }
  }
  const auto count = static_cast<double>(runs.size());
  double cells = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    cells *= (static_cast<double>(all.upper[axis]) - all.lower[axis]) / (extent[axis] / count);
  }
  const double coarser = 1.5 * std::cbrt(std::max(1.0, cells / count));
  for (int axis = 0; axis < 3; ++axis)
  {
    const double inverse = count / (coarser * extent[axis]);
    this->Lower[axis] = all.lower[axis];
    this->InverseSize[axis] = static_cast<float>(inverse);
    this->Last[axis] = static_cast<float>(std::floor((static_cast<double>(all.upper[axis]) - all.lower[axis]) * inverse));
  }
}

BoxQuery RunGrid::queryOf(const RunBox& box) const
{
  BoxQuery query = {};
  for (int axis = 0; axis < 3; ++axis)
  {
    query.lower[axis] = box.lower[axis];
    query.upper[axis] = box.upper[axis];
    query.origin[axis] = this->Lower[axis];
    query.inverseSize[axis] = this->InverseSize[axis];
    query.last[axis] = this->Last[axis];
  }
  return query;
}

RunGridEntries::RunGridEntries(const std::vector<RunBox>& runs, const RunGrid& grid, int threads)
  : Start(grid.size() + 1)
{
  this->count(runs, grid, threads);
  this->allocate(this->Start.back());
  this->fillKeys(runs, grid, threads);
  this->fillBoxes(runs, grid, threads);
}

/// Sets Start to the end of each cell.
void RunGridEntries::count(const std::vector<RunBox>& runs, const RunGrid& grid, int threads)
{
  parallelForInBlocks(runs.size(), runsTogether, threads,
    [&](std::size_t i)
    { grid.forEachCell(runs[i], [&](std::size_t cell) { __atomic_add_fetch(&this->Start[cell], 1, __ATOMIC_RELAXED); }); });
  std::size_t sum = 0;
  for (std::size_t& entry : this->Start)
  {
    sum += entry;
    entry = sum;
  }
}

void RunGridEntries::allocate(std::size_t entries)
{
  const std::size_t padded = entries + SearchKernels::padding;
  constexpr std::size_t many = 1000000;
  if (entries > many)
  {
    requireMemory(static_cast<double>(padded) * (6 * sizeof(float) + 2 * sizeof(std::uint32_t)), "the search for neighbours",
      "use segments of more even length");
  }
  this->Keys.reset(new std::uint32_t[padded]);
  this->Cells.reset(new std::int32_t[padded]);
  for (auto& column : this->Numbers)
  {
    column.reset(new float[padded]);
    std::fill_n(column.get() + entries, SearchKernels::padding, 0.0f);
  }
  std::fill_n(this->Keys.get() + entries, SearchKernels::padding, 0);
  std::fill_n(this->Cells.get() + entries, SearchKernels::padding, -1);
}

/// Fills each cell from its end towards its start; Start then holds the starts.
void RunGridEntries::fillKeys(const std::vector<RunBox>& runs, const RunGrid& grid, int threads)
{
  parallelForInBlocks(runs.size(), runsTogether, threads,
    [&](std::size_t i)
    {
      grid.forEachCell(runs[i],
        [&](std::size_t cell)
        {
          const std::size_t place = __atomic_sub_fetch(&this->Start[cell], 1, __ATOMIC_RELAXED);
          this->Keys[place] = static_cast<std::uint32_t>(i);
        });
    });
}

void RunGridEntries::fillBoxes(const std::vector<RunBox>& runs, const RunGrid& grid, int threads)
{
  const std::size_t row = grid.rowLength();
  parallelForInBlocks(this->Start.size() - 1, cellsTogether, threads,
    [&](std::size_t cell)
    {
      for (std::size_t m = this->Start[cell]; m < this->Start[cell + 1]; ++m)
      {
        const RunBox& box = runs[this->Keys[m]];
        for (int axis = 0; axis < 3; ++axis)
        {
          this->Numbers[axis][m] = box.lower[axis];
          this->Numbers[3 + axis][m] = box.upper[axis];
        }
        this->Cells[m] = static_cast<std::int32_t>(cell % row);
      }
    });
}

BoxColumns RunGridEntries::columns() const
{
  return { { this->Numbers[0].get(), this->Numbers[1].get(), this->Numbers[2].get() },
    { this->Numbers[3].get(), this->Numbers[4].get(), this->Numbers[5].get() }, this->Cells.get(), this->Keys.get() };
}

} // namespace cactus
