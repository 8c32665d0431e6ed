// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "optimiser/CapsuleRuns.h"
#include "optimiser/SearchKernels.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace cactus
{

/// A uniform grid of cells over the boxes of runs.
class RunGrid
{
public:
  /// Makes cells 1.5 times as large as the mean box along each axis, and fewer of them than runs.
  explicit RunGrid(const std::vector<RunBox>& runs);

  std::size_t size() const { return this->index(this->Last.cast<int>()) + 1; }

  /// Returns the number of cells along x.
  std::size_t rowLength() const { return std::size_t(this->Last[0]) + 1; }

  /// Returns the cell of a position; it is monotonic in each coordinate.
  Eigen::Array4i cellOf(const Eigen::Array4f& position) const
  {
    const Eigen::Array4f cell = (position - this->Lower) * this->InverseSize;
    return cell.max(Eigen::Array4f::Zero()).min(this->Last).cast<int>();
  }

  std::size_t index(int x, int y, int z) const
  {
    return std::size_t(x) +
           (std::size_t(this->Last[0]) + 1) * (std::size_t(y) + (std::size_t(this->Last[1]) + 1) * std::size_t(z));
  }

  /// Returns the query for the rows of cells that the box touches; the caller fills in the row.
  BoxQuery queryOf(const RunBox& box) const;

  /// Calls visit(index) for every cell that the box touches.
  template <typename Visit>
  void forEachCell(const RunBox& box, Visit&& visit) const
  {
    const Eigen::Array4i first = this->cellOf(box.lower);
    const Eigen::Array4i last = this->cellOf(box.upper);
    for (int z = first[2]; z <= last[2]; ++z)
    {
      for (int y = first[1]; y <= last[1]; ++y)
      {
        const std::size_t row = this->index(0, y, z);
        for (int x = first[0]; x <= last[0]; ++x)
        {
          visit(row + std::size_t(x));
        }
      }
    }
  }

private:
  std::size_t index(const Eigen::Array4i& cell) const { return this->index(cell[0], cell[1], cell[2]); }

  Eigen::Array4f Lower = Eigen::Array4f::Zero();
  Eigen::Array4f InverseSize = Eigen::Array4f::Zero();
  Eigen::Array4f Last = Eigen::Array4f::Zero(); ///< largest index along each axis
};

/// The runs that touch each cell of a grid, one column per number.
class RunGridEntries
{
public:
  /// Fills the cells by a counting sort. The order within a cell depends on the threads: sort the runs taken from it. Throws
  /// OutOfMemory.
  RunGridEntries(const std::vector<RunBox>& runs, const RunGrid& grid, int threads);

  /// Returns the first entry of a cell: those of cell c are start(c) … start(c + 1) − 1.
  std::size_t start(std::size_t cell) const { return this->Start[cell]; }

  BoxColumns columns() const;

private:
  void count(const std::vector<RunBox>& runs, const RunGrid& grid, int threads);
  void allocate(std::size_t entries);
  void fillKeys(const std::vector<RunBox>& runs, const RunGrid& grid, int threads);
  void fillBoxes(const std::vector<RunBox>& runs, const RunGrid& grid, int threads);

  std::vector<std::size_t> Start;
  std::unique_ptr<float[]> Numbers[6];   ///< lower and upper corners of the boxes
  std::unique_ptr<std::int32_t[]> Cells; ///< index along x
  std::unique_ptr<std::uint32_t[]> Keys; ///< indices of the runs
};

} // namespace cactus
