// SPDX-License-Identifier: BSD-3-Clause
#include "NeighbourSearch.h"

#include "Error.h"
#include "SegmentDistance.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cactus
{

namespace
{

struct Box
{
  float lower[3];
  float upper[3];
};

using CellRange = std::array<std::array<int, 3>, 2>;

/// A uniform grid over the capsules' bounding box.
struct CellGrid
{
  double lower[3];
  double inverseSize = 1.0;
  int count[3];

  int cellOf(double x, int axis) const
  {
    const double cell = std::floor((x - lower[axis]) * inverseSize);
    return static_cast<int>(std::min(std::max(cell, 0.0), count[axis] - 1.0));
  }
  CellRange range(const Box& box) const
  {
    CellRange cells;
    for (int axis = 0; axis < 3; ++axis)
    {
      cells[0][axis] = cellOf(box.lower[axis], axis);
      cells[1][axis] = cellOf(box.upper[axis], axis);
    }
    return cells;
  }
  std::array<int, 3> position(std::size_t cell) const
  {
    const auto x = static_cast<int>(cell % std::size_t(count[0]));
    const auto rest = cell / std::size_t(count[0]);
    return { { x, static_cast<int>(rest % std::size_t(count[1])), static_cast<int>(rest / std::size_t(count[1])) } };
  }
  std::size_t index(int i, int j, int k) const
  {
    return std::size_t(i) + std::size_t(count[0]) * (std::size_t(j) + std::size_t(count[1]) * std::size_t(k));
  }
};

Box boxOf(const Capsule& capsule, double extra)
{
  Box box;
  const double radius = std::max(capsule.r0, capsule.r1) + extra;
  for (int axis = 0; axis < 3; ++axis)
  {
    // Rounded outwards: single precision must not lose a pair.
    box.lower[axis] = std::nextafter(static_cast<float>(std::min(capsule.p0[axis], capsule.p1[axis]) - radius), -INFINITY);
    box.upper[axis] = std::nextafter(static_cast<float>(std::max(capsule.p0[axis], capsule.p1[axis]) + radius), INFINITY);
  }
  return box;
}

bool within(const Capsule& p, const Capsule& q, double reach)
{
  double a = 0.0, b = 0.0, c = 0.0, e = 0.0, f = 0.0;
  double d1[3], d2[3], r[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    d1[axis] = p.p1[axis] - p.p0[axis];
    d2[axis] = q.p1[axis] - q.p0[axis];
    r[axis] = p.p0[axis] - q.p0[axis];
    a += d1[axis] * d1[axis];
    b += d1[axis] * d2[axis];
    c += d1[axis] * r[axis];
    e += d2[axis] * d2[axis];
    f += d2[axis] * r[axis];
  }
  double s = 0.0, t = 0.0;
  closestParameters(a, e, b, c, f, s, t);
  double squared = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double difference = r[axis] + s * d1[axis] - t * d2[axis];
    squared += difference * difference;
  }
  const double limit = std::max(p.r0, p.r1) + std::max(q.r0, q.r1) + reach;
  return squared < limit * limit;
}

CellGrid gridFor(const std::vector<Box>& boxes)
{
  double lower[3] = { INFINITY, INFINITY, INFINITY };
  double upper[3] = { -INFINITY, -INFINITY, -INFINITY };
  double extent = 0.0;
  for (const Box& box : boxes)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::min<double>(lower[axis], box.lower[axis]);
      upper[axis] = std::max<double>(upper[axis], box.upper[axis]);
      extent += box.upper[axis] - box.lower[axis];
    }
  }
  // Cells about as large as the mean bounding box, but no more of them than twice the capsules.
  double size = extent / (3.0 * static_cast<double>(boxes.size()));
  const double volume = (upper[0] - lower[0]) * (upper[1] - lower[1]) * (upper[2] - lower[2]);
  size = std::max(size, std::cbrt(volume / (2.0 * static_cast<double>(boxes.size()))));
  CellGrid grid;
  grid.inverseSize = 1.0 / size;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.lower[axis] = lower[axis];
    grid.count[axis] = static_cast<int>((upper[axis] - lower[axis]) * grid.inverseSize) + 1;
  }
  return grid;
}

/// A capsule as a cell sees it; everything that rejects a pair lies side by side.
struct Entry
{
  Box box;
  std::array<int, 3> cell; ///< the first cell that the box reaches
  std::uint32_t capsule;
  std::uint32_t fibre;
};

bool overlap(const Box& a, const Box& b)
{
  return a.lower[0] <= b.upper[0] && b.lower[0] <= a.upper[0] && a.lower[1] <= b.upper[1] && b.lower[1] <= a.upper[1] &&
         a.lower[2] <= b.upper[2] && b.lower[2] <= a.upper[2];
}

/// Counting sort of the capsules into all cells that their boxes reach; within a cell they stay in increasing order. The entries
/// of cell c are start[c] … start[c + 1] − 1.
std::vector<Entry> enterCells(
  const Capsules& capsules, const std::vector<Box>& boxes, const CellGrid& grid, std::vector<std::size_t>& start)
{
  const auto forEachCell = [&](std::size_t k, auto&& visit)
  {
    const CellRange range = grid.range(boxes[k]);
    for (int z = range[0][2]; z <= range[1][2]; ++z)
    {
      for (int y = range[0][1]; y <= range[1][1]; ++y)
      {
        for (int x = range[0][0]; x <= range[1][0]; ++x)
        {
          visit(grid.index(x, y, z), range[0]);
        }
      }
    }
  };
  const std::size_t cells = grid.index(0, 0, grid.count[2]);
  start.assign(cells + 1, 0);
  for (std::size_t k = 0; k < boxes.size(); ++k)
  {
    forEachCell(k, [&](std::size_t cell, const std::array<int, 3>&) { ++start[cell + 1]; });
  }
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    start[cell + 1] += start[cell];
  }
  std::vector<Entry> entries(start[cells]);
  std::vector<std::size_t> cursor(start.begin(), start.end() - 1);
  for (std::size_t k = 0; k < boxes.size(); ++k)
  {
    forEachCell(k,
      [&](std::size_t cell, const std::array<int, 3>& first) {
        entries[cursor[cell]++] = { boxes[k], first, static_cast<std::uint32_t>(k), capsules.fibre[k] };
      });
  }
  return entries;
}

} // namespace

void findNeighbours(const Capsules& capsules, double reach, int threads, NeighbourList& list)
{
  const std::size_t count = capsules.size();
  list.offsets.assign(count + 1, 0);
  list.indices.clear();
  if (count == 0)
  {
    return;
  }
  std::vector<Box> boxes(count);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::size_t k = 0; k < count; ++k)
  {
    boxes[k] = boxOf(capsules.bodies[k], 0.5 * reach);
  }
  const CellGrid grid = gridFor(boxes);
  std::vector<std::size_t> start;
  const std::vector<Entry> entries = enterCells(capsules, boxes, grid, start);

  // Blocks of cells, each with a list of pairs of its own.
  const std::size_t cells = start.size() - 1;
  constexpr std::size_t blockSize = 4096;
  const std::size_t blocks = (cells + blockSize - 1) / blockSize;
  std::vector<std::vector<std::array<std::uint32_t, 2>>> pairs(blocks);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
  for (std::size_t block = 0; block < blocks; ++block)
  {
    const std::size_t end = std::min(cells, (block + 1) * blockSize);
    for (std::size_t cell = block * blockSize; cell < end; ++cell)
    {
      const std::array<int, 3> here = grid.position(cell);
      for (std::size_t m = start[cell]; m < start[cell + 1]; ++m)
      {
        const Entry& one = entries[m];
        for (std::size_t n = m + 1; n < start[cell + 1]; ++n)
        {
          const Entry& other = entries[n];
          // Two boxes may share several cells: the pair is taken in the first one only.
          if (one.fibre != other.fibre && overlap(one.box, other.box) && std::max(one.cell[0], other.cell[0]) == here[0] &&
              std::max(one.cell[1], other.cell[1]) == here[1] && std::max(one.cell[2], other.cell[2]) == here[2] &&
              within(capsules.bodies[one.capsule], capsules.bodies[other.capsule], reach))
          {
            pairs[block].push_back({ { one.capsule, other.capsule } });
          }
        }
      }
    }
  }

  for (const auto& found : pairs)
  {
    for (const auto& pair : found)
    {
      ++list.offsets[pair[0] + 1];
      ++list.offsets[pair[1] + 1];
    }
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    list.offsets[k + 1] += list.offsets[k];
  }
  list.indices.resize(list.offsets[count]);
  std::vector<std::size_t> cursor(list.offsets.begin(), list.offsets.end() - 1);
  for (auto& found : pairs)
  {
    for (const auto& pair : found)
    {
      list.indices[cursor[pair[0]]++] = pair[1];
      list.indices[cursor[pair[1]]++] = pair[0];
    }
    std::vector<std::array<std::uint32_t, 2>>().swap(found);
  }
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::size_t k = 0; k < count; ++k)
  {
    std::sort(list.indices.begin() + static_cast<std::ptrdiff_t>(list.offsets[k]),
      list.indices.begin() + static_cast<std::ptrdiff_t>(list.offsets[k + 1]));
  }
}

} // namespace cactus
