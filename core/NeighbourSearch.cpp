// SPDX-License-Identifier: BSD-3-Clause
#include "NeighbourSearch.h"

#include "VectorKernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cactus
{

namespace
{

constexpr std::size_t runLength = 6;
constexpr std::size_t width = 16;

typedef float Four __attribute__((vector_size(16)));
typedef std::int32_t FourInts __attribute__((vector_size(16)));

/// A bounding box; the fourth number of each corner means nothing.
struct Box
{
  Four lower;
  Four upper;
};

/// A run as a cell sees it: consecutive capsules of one fibre. The fourth numbers of the box hold the first of them and one past
/// the last.
struct Run
{
  Box box;

  void setRange(std::uint32_t first, std::uint32_t last)
  {
    std::memcpy(reinterpret_cast<char*>(&this->box.lower) + 12, &first, 4);
    std::memcpy(reinterpret_cast<char*>(&this->box.upper) + 12, &last, 4);
  }
  std::uint32_t first() const { return fourth(this->box.lower); }
  std::uint32_t last() const { return fourth(this->box.upper); }

private:
  static std::uint32_t fourth(const Four& corner)
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, reinterpret_cast<const char*>(&corner) + 12, 4);
    return bits;
  }
};

inline Four larger(const Four& a, const Four& b)
{
  return a > b ? a : b;
}

inline Four smaller(const Four& a, const Four& b)
{
  return a < b ? a : b;
}

/// A capsule's bounding box, larger by its reach. Two boxes of capsules within reach of each other overlap; a last
/// part in a million sees to it that single precision does not lose a pair.
Box boxOf(const Capsule& capsule, float reach)
{
  const double radius = std::max(capsule.r0, capsule.r1) + static_cast<double>(reach);
  Box box = {};
  for (int axis = 0; axis < 3; ++axis)
  {
    const double lower = std::min(capsule.p0[axis], capsule.p1[axis]) - radius;
    const double upper = std::max(capsule.p0[axis], capsule.p1[axis]) + radius;
    box.lower[axis] = static_cast<float>(lower - 1e-6 * std::abs(lower));
    box.upper[axis] = static_cast<float>(upper + 1e-6 * std::abs(upper));
  }
  return box;
}

void extend(Box& box, const Box& by)
{
  box.lower = smaller(box.lower, by.lower);
  box.upper = larger(box.upper, by.upper);
}

std::vector<Run> runsOf(const Capsules& capsules, const std::vector<float>& reach, int threads)
{
  std::vector<std::uint32_t> first;
  for (std::size_t k = 0; k < capsules.size();)
  {
    first.push_back(static_cast<std::uint32_t>(k));
    const std::size_t begin = k;
    while (k < capsules.size() && k < begin + runLength && capsules.fibre[k] == capsules.fibre[begin])
    {
      ++k;
    }
  }
  std::vector<Run> runs(first.size());
  first.push_back(static_cast<std::uint32_t>(capsules.size()));
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    runs[i].box = boxOf(capsules.bodies[first[i]], reach[first[i]]);
    for (std::uint32_t k = first[i] + 1; k < first[i + 1]; ++k)
    {
      extend(runs[i].box, boxOf(capsules.bodies[k], reach[k]));
    }
    runs[i].setRange(first[i], first[i + 1]);
  }
  return runs;
}

/// A uniform grid over the runs' bounding box.
class CellGrid
{
public:
  /// Cells half as large again as the mean run along each axis, and fewer of them than runs.
  explicit CellGrid(const std::vector<Run>& runs)
  {
    Box all = runs.front().box;
    double extent[3] = {};
    for (const Run& run : runs)
    {
      extend(all, run.box);
      const Four size = run.box.upper - run.box.lower;
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

  std::size_t size() const
  {
    return this->index(static_cast<int>(this->Last[0]), static_cast<int>(this->Last[1]), static_cast<int>(this->Last[2])) + 1;
  }

  /// Cells along x.
  std::size_t rowLength() const { return std::size_t(this->Last[0]) + 1; }

  /// Increases with each coordinate, so that the cell of the larger of two coordinates is the larger of their cells.
  FourInts cellOf(const Four& position) const
  {
    const Four cell = (position - this->Lower) * this->InverseSize;
    return __builtin_convertvector(smaller(larger(cell, Four{}), this->Last), FourInts);
  }

  std::size_t index(int x, int y, int z) const
  {
    return std::size_t(x) +
           (std::size_t(this->Last[0]) + 1) * (std::size_t(y) + (std::size_t(this->Last[1]) + 1) * std::size_t(z));
  }

  /// What to look for in the rows of cells that the box reaches, but for the row.
  BoxQuery queryOf(const Box& box) const
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

  /// visit(cell, index) for every cell that the box reaches.
  template <typename Visit>
  void forEachCell(const Box& box, Visit&& visit) const
  {
    const FourInts first = this->cellOf(box.lower);
    const FourInts last = this->cellOf(box.upper);
    for (int z = first[2]; z <= last[2]; ++z)
    {
      for (int y = first[1]; y <= last[1]; ++y)
      {
        const std::size_t row = this->index(0, y, z);
        for (int x = first[0]; x <= last[0]; ++x)
        {
          visit(FourInts{ x, y, z, 0 }, row + std::size_t(x));
        }
      }
    }
  }

private:
  Four Lower = {};
  Four InverseSize = {};
  Four Last = {};
};

/// Counting sort of the runs into all cells that their boxes reach: those of cell c are at start[c] … start[c + 1] − 1, in an
/// order that depends on the threads; whoever reads them sorts what is taken.
std::vector<Run> enterCells(const std::vector<Run>& runs, const CellGrid& grid, int threads, std::vector<std::size_t>& start)
{
  const std::size_t cells = grid.size();
  start.assign(cells + 1, 0);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    grid.forEachCell(runs[i].box,
      [&](const FourInts&, std::size_t cell)
      {
#pragma omp atomic
        ++start[cell];
      });
  }
  std::size_t sum = 0;
  for (std::size_t& entry : start)
  {
    sum += entry;
    entry = sum;
  }
  std::vector<Run> entries(sum);
  // From the end of each cell towards its start, which is where its cursor is left.
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    grid.forEachCell(runs[i].box,
      [&](const FourInts&, std::size_t cell)
      {
        std::size_t place = 0;
#pragma omp atomic capture
        place = --start[cell];
        entries[place] = runs[i];
      });
  }
  return entries;
}

/// The entries of all cells, one column per number.
struct CellEntries
{
  std::vector<float> numbers[6];   ///< lower and upper corners of the boxes
  std::vector<std::int32_t> cells; ///< along x
  std::vector<std::uint64_t> keys; ///< first capsule in the upper half, one past the last in the lower

  CellEntries(const std::vector<Run>& entries, const std::vector<std::size_t>& start, const CellGrid& grid, int threads)
    : cells(entries.size() + width, -1)
    , keys(entries.size() + width)
  {
    for (auto& column : this->numbers)
    {
      column.resize(entries.size() + width);
    }
    const std::size_t row = grid.rowLength();
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t cell = 0; cell < start.size() - 1; ++cell)
    {
      for (std::size_t m = start[cell]; m < start[cell + 1]; ++m)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          this->numbers[axis][m] = entries[m].box.lower[axis];
          this->numbers[3 + axis][m] = entries[m].box.upper[axis];
        }
        this->cells[m] = static_cast<std::int32_t>(cell % row);
        this->keys[m] = (std::uint64_t(entries[m].first()) << 32) | entries[m].last();
      }
    }
  }

  BoxColumns columns() const
  {
    return { { this->numbers[0].data(), this->numbers[1].data(), this->numbers[2].data() },
      { this->numbers[3].data(), this->numbers[4].data(), this->numbers[5].data() }, this->cells.data(), this->keys.data() };
  }
};

/// The capsules that may be within reach of a run, relative to a point near it so that single precision is enough, padded to
/// whole vectors with capsules that are far away.
class Candidates
{
public:
  /// Makes room for `count`, all far away.
  void reset(std::size_t count)
  {
    this->Size = 0;
    const std::size_t padded = (count + width - 1) / width * width;
    if (padded > this->Capacity)
    {
      this->Capacity = 2 * padded;
      this->Numbers.resize(7 * this->Capacity);
      this->Indices.resize(this->Capacity);
    }
    for (int number = 0; number < 7; ++number)
    {
      const float far = number < 3 ? 1e9f : number < 6 ? 1.001e9f : 0.0f;
      float* column = this->column(number);
      for (std::size_t i = padded > width ? padded - width : 0; i < padded; ++i)
      {
        column[i] = far;
      }
    }
  }
  void add(std::uint32_t index, const Capsule& capsule, const double (&origin)[3], float reach)
  {
    float* place = this->Numbers.data() + this->Size;
    for (int axis = 0; axis < 3; ++axis)
    {
      place[std::size_t(axis) * this->Capacity] = static_cast<float>(capsule.p0[axis] - origin[axis]);
      place[std::size_t(axis + 3) * this->Capacity] = static_cast<float>(capsule.p1[axis] - origin[axis]);
    }
    place[6 * this->Capacity] = static_cast<float>(std::max(capsule.r0, capsule.r1)) + reach;
    this->Indices[this->Size++] = index;
  }
  std::size_t size() const { return this->Size; }
  const float* column(int number) const { return this->Numbers.data() + std::size_t(number) * this->Capacity; }
  float* column(int number) { return this->Numbers.data() + std::size_t(number) * this->Capacity; }
  const std::uint32_t* indices() const { return this->Indices.data(); }

private:
  std::size_t Size = 0;
  std::size_t Capacity = 0;
  std::vector<float> Numbers; ///< columns: p0, p1, largest radius plus reach
  std::vector<std::uint32_t> Indices;
};

/// Finds the neighbours of the capsules of one run.
class RunSearch
{
public:
  RunSearch(const Capsules& capsules, const std::vector<float>& reach, const CellGrid& grid,
    const std::vector<std::size_t>& start, const BoxColumns& columns)
    : Bodies(capsules)
    , Reach(reach)
    , Grid(grid)
    , Start(start)
    , Columns(columns)
  {
  }

  /// Appends to `indices`; counts[k] becomes the number of neighbours of capsule k.
  void find(const Run& run, std::vector<std::uint32_t>& indices, std::size_t* counts)
  {
    this->collect(run);
    double origin[3];
    std::copy_n(this->Bodies.bodies[run.first()].p0, 3, origin);
    std::size_t count = 0;
    for (const std::uint64_t other : this->Others)
    {
      count += std::uint32_t(other) - std::uint32_t(other >> 32);
    }
    this->Near.reset(count);
    for (const std::uint64_t other : this->Others)
    {
      for (auto k = std::uint32_t(other >> 32); k < std::uint32_t(other); ++k)
      {
        this->Near.add(k, this->Bodies.bodies[k], origin, this->Reach[k]);
      }
    }
    this->Found.resize(std::max(this->Found.size(), count + width));
    const float* columns[7];
    for (int number = 0; number < 7; ++number)
    {
      columns[number] = this->Near.column(number);
    }
    for (std::uint32_t k = run.first(); k < run.last(); ++k)
    {
      const Capsule& body = this->Bodies.bodies[k];
      float numbers[7];
      for (int axis = 0; axis < 3; ++axis)
      {
        numbers[axis] = static_cast<float>(body.p0[axis] - origin[axis]);
        numbers[3 + axis] = static_cast<float>(body.p1[axis] - origin[axis]);
      }
      numbers[6] = static_cast<float>(std::max(body.r0, body.r1)) + this->Reach[k];
      const std::uint32_t* end =
        this->Kernels.selectNeighbours(columns, this->Near.indices(), count, numbers, this->Found.data());
      indices.insert(indices.end(), static_cast<const std::uint32_t*>(this->Found.data()), end);
      counts[k] = static_cast<std::size_t>(end - this->Found.data());
    }
  }

private:
  /// The runs of other fibres whose boxes overlap this one's, in increasing order.
  void collect(const Run& run)
  {
    const FourInts first = this->Grid.cellOf(run.box.lower);
    const FourInts last = this->Grid.cellOf(run.box.upper);
    BoxQuery query = this->Grid.queryOf(run.box);
    std::size_t taken = 0;
    for (query.z = first[2]; query.z <= last[2]; ++query.z)
    {
      for (query.y = first[1]; query.y <= last[1]; ++query.y)
      {
        const std::size_t begin = this->Start[this->Grid.index(first[0], query.y, query.z)];
        const std::size_t end = this->Start[this->Grid.index(last[0], query.y, query.z) + 1];
        this->Others.resize(std::max(this->Others.size(), taken + end - begin + width));
        const std::uint64_t* next = this->Kernels.selectBoxes(this->Columns, begin, end, query, this->Others.data() + taken);
        taken = static_cast<std::size_t>(next - this->Others.data());
      }
    }
    this->Others.resize(taken);
    const std::uint32_t fibre = this->Bodies.fibre[run.first()];
    this->Others.erase(std::remove_if(this->Others.begin(), this->Others.end(),
                         [&](std::uint64_t other) { return this->Bodies.fibre[other >> 32] == fibre; }),
      this->Others.end());
    std::sort(this->Others.begin(), this->Others.end());
  }

  const Capsules& Bodies;
  const std::vector<float>& Reach;
  const CellGrid& Grid;
  const std::vector<std::size_t>& Start;
  const BoxColumns Columns;
  const VectorKernels& Kernels = vectorKernels();
  std::vector<std::uint64_t> Others; ///< see CellEntries::keys
  Candidates Near;
  std::vector<std::uint32_t> Found;
};

} // namespace

void findNeighbours(const Capsules& capsules, const std::vector<float>& reach, int threads, NeighbourList& list)
{
  const std::size_t count = capsules.size();
  list.offsets.assign(count + 1, 0);
  list.indices.clear();
  if (count == 0)
  {
    return;
  }
  const std::vector<Run> runs = runsOf(capsules, reach, threads);
  constexpr std::size_t blockSize = 1024;
  const std::size_t blocks = (runs.size() + blockSize - 1) / blockSize;
  std::vector<std::vector<std::uint32_t>> found(blocks); // joined once all are known
  {
    const CellGrid grid(runs);
    std::vector<std::size_t> start;
    const std::vector<Run> filled = enterCells(runs, grid, threads, start);
    const CellEntries entries(filled, start, grid, threads);
    const BoxColumns columns = entries.columns();
#pragma omp parallel num_threads(threads)
    {
      RunSearch search(capsules, reach, grid, start, columns);
#pragma omp for schedule(dynamic, 1)
      for (std::size_t block = 0; block < blocks; ++block)
      {
        const std::size_t end = std::min(runs.size(), (block + 1) * blockSize);
        for (std::size_t i = block * blockSize; i < end; ++i)
        {
          search.find(runs[i], found[block], list.offsets.data() + 1);
        }
      }
    }
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    list.offsets[k + 1] += list.offsets[k];
  }
  list.indices.resize(list.offsets[count]);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::size_t block = 0; block < blocks; ++block)
  {
    const std::size_t begin = list.offsets[runs[block * blockSize].first()];
    std::copy(found[block].begin(), found[block].end(), list.indices.begin() + static_cast<std::ptrdiff_t>(begin));
    std::vector<std::uint32_t>().swap(found[block]);
  }
}

void findNeighbours(const Capsules& capsules, double reach, int threads, NeighbourList& list)
{
  findNeighbours(capsules, std::vector<float>(capsules.size(), static_cast<float>(0.5 * reach)), threads, list);
}

} // namespace cactus
