// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/NeighbourSearch.h"

#include "base/Error.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "optimiser/VectorKernels.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>

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

inline Four larger(const Four& a, const Four& b)
{
  return a > b ? a : b;
}

inline Four smaller(const Four& a, const Four& b)
{
  return a < b ? a : b;
}

/// A capsule's bounding box, larger by its reach. Two boxes of capsules within reach of each other overlap; a last part in a
/// million sees to it that single precision does not lose a pair.
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

/// A box that overlaps none.
Box nothing()
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Four corner = { infinity, infinity, infinity, 0.0f };
  return { corner, -corner };
}

void extend(Box& box, const Box& by)
{
  box.lower = smaller(box.lower, by.lower);
  box.upper = larger(box.upper, by.upper);
}

/// Runs of consecutive capsules of one fibre.
struct Runs
{
  std::vector<std::uint32_t> first; ///< capsule of each, and one past the last
  std::vector<Box> boxes;
  std::unique_ptr<BoxBlock[]> blocks; ///< of their capsules

  std::size_t size() const { return this->boxes.size(); }

  Runs(const Capsules& capsules, const std::vector<float>& reach, int threads)
  {
    for (std::size_t k = 0; k < capsules.size();)
    {
      this->first.push_back(static_cast<std::uint32_t>(k));
      const std::size_t begin = k;
      while (k < capsules.size() && k < begin + runLength && capsules.fibre[k] == capsules.fibre[begin])
      {
        ++k;
      }
    }
    const std::size_t count = this->first.size();
    this->first.push_back(static_cast<std::uint32_t>(capsules.size()));
    this->boxes.resize(count);
    this->blocks.reset(new BoxBlock[count]);
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t i = 0; i < count; ++i)
    {
      Box all = nothing();
      BoxBlock& block = this->blocks[i];
      for (std::uint32_t l = 0; l < 8; ++l)
      {
        const std::uint32_t k = this->first[i] + l;
        const Box box = k < this->first[i + 1] ? boxOf(capsules.bodies[k], reach[k]) : nothing();
        extend(all, box);
        for (int axis = 0; axis < 3; ++axis)
        {
          block.bounds[axis][l] = box.lower[axis];
          block.bounds[axis][8 + l] = -box.upper[axis];
        }
      }
      this->boxes[i] = all;
    }
  }
};

/// A uniform grid over the runs' bounding box.
class CellGrid
{
public:
  /// Cells half as large again as the mean run along each axis, and fewer of them than runs.
  explicit CellGrid(const std::vector<Box>& runs)
  {
    Box all = runs.front();
    double extent[3] = {};
    for (const Box& run : runs)
    {
      extend(all, run);
      const Four size = run.upper - run.lower;
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

  /// visit(index) for every cell that the box reaches.
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
          visit(row + std::size_t(x));
        }
      }
    }
  }

private:
  Four Lower = {};
  Four InverseSize = {};
  Four Last = {};
};

/// The runs in all cells that their boxes reach, one column per number.
class CellEntries
{
public:
  /// A counting sort. The order within a cell depends on the threads; whoever reads it sorts what is taken.
  CellEntries(const std::vector<Box>& runs, const CellGrid& grid, int threads)
    : Start(grid.size() + 1)
  {
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t i = 0; i < runs.size(); ++i)
    {
      grid.forEachCell(runs[i],
        [&](std::size_t cell)
        {
#pragma omp atomic
          ++this->Start[cell];
        });
    }
    std::size_t sum = 0;
    for (std::size_t& entry : this->Start)
    {
      sum += entry;
      entry = sum;
    }
    const std::size_t padded = sum + width;
    constexpr std::size_t many = 1000000;
    if (sum > many)
    {
      requireMemory(static_cast<double>(padded) * (6 * sizeof(float) + 2 * sizeof(std::uint32_t)), "the search for neighbours",
        "use segments of more even length");
    }
    this->Keys.reset(new std::uint32_t[padded]);
    this->Cells.reset(new std::int32_t[padded]);
    for (auto& column : this->Numbers)
    {
      column.reset(new float[padded]);
      std::fill_n(column.get() + sum, width, 0.0f);
    }
    std::fill_n(this->Keys.get() + sum, width, 0);
    std::fill_n(this->Cells.get() + sum, width, -1);
    // From the end of each cell towards its start, which is where its cursor is left.
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t i = 0; i < runs.size(); ++i)
    {
      grid.forEachCell(runs[i],
        [&](std::size_t cell)
        {
          std::size_t place = 0;
#pragma omp atomic capture
          place = --this->Start[cell];
          this->Keys[place] = static_cast<std::uint32_t>(i);
        });
    }
    const std::size_t row = grid.rowLength();
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t cell = 0; cell < this->Start.size() - 1; ++cell)
    {
      for (std::size_t m = this->Start[cell]; m < this->Start[cell + 1]; ++m)
      {
        const Box& box = runs[this->Keys[m]];
        for (int axis = 0; axis < 3; ++axis)
        {
          this->Numbers[axis][m] = box.lower[axis];
          this->Numbers[3 + axis][m] = box.upper[axis];
        }
        this->Cells[m] = static_cast<std::int32_t>(cell % row);
      }
    }
  }

  /// The entries of cell c are those from start(c) to before start(c + 1).
  std::size_t start(std::size_t cell) const
  {
    return this->Start[cell];
  }

  BoxColumns columns() const
  {
    return { { this->Numbers[0].get(), this->Numbers[1].get(), this->Numbers[2].get() },
      { this->Numbers[3].get(), this->Numbers[4].get(), this->Numbers[5].get() }, this->Cells.get(), this->Keys.get() };
  }

private:
  std::vector<std::size_t> Start;
  std::unique_ptr<float[]> Numbers[6];   ///< lower and upper corners of the boxes
  std::unique_ptr<std::int32_t[]> Cells; ///< along x
  std::unique_ptr<std::uint32_t[]> Keys; ///< numbers of the runs
};

/// Room for the columns of capsules near a run.
class NearCapsules
{
public:
  NearColumns columnsFor(std::size_t count)
  {
    const std::size_t padded = (count + width - 1) / width * width;
    if (padded > this->Stride)
    {
      this->Stride = 2 * padded;
      this->Numbers.resize(NearColumns::count * this->Stride);
    }
    return { this->Numbers.data(), this->Stride };
  }

private:
  std::size_t Stride = 0;
  std::vector<float> Numbers;
};

/// Counts what all threads find, and ends the search once it could not be held: where very many fibres lie in one place, their
/// pairs grow with the square of their number.
class Bound
{
public:
  Bound()
    : Most(availableMemory() / bytesPerPair)
  {
  }

  void add(std::size_t pairs)
  {
    if ((this->Found += pairs) > this->Most)
    {
      throw OutOfMemory("so many capsules lie within reach of each other that their pairs do not fit into memory: are fibres "
                        "there several times, or radii in another unit than coordinates?");
    }
  }

private:
  /// As it is found, with room for as much again, and joined.
  static constexpr std::size_t bytesPerPair = 4 * sizeof(std::uint32_t);
  const std::size_t Most;
  std::atomic<std::size_t> Found{ 0 };
};

/// Finds the neighbours of the capsules of one run after the other.
class RunSearch
{
public:
  RunSearch(const Capsules& capsules, const std::vector<float>& reach, const Runs& runs, const CellGrid& grid,
    const CellEntries& entries, Bound& bound)
    : Bodies(capsules)
    , Reach(reach)
    , AllRuns(runs)
    , Grid(grid)
    , Entries(entries)
    , Pairs(bound)
  {
  }

  /// counts[k] becomes the number of neighbours of capsule k.
  void find(std::size_t run, std::size_t* counts)
  {
    const std::size_t count = this->collect(run);
    const std::uint32_t first = this->AllRuns.first[run];
    const Capsule* bodies = this->Bodies.bodies.data();
    const double(&origin)[3] = bodies[first].p0;
    const NearColumns near = this->Near.columnsFor(count);
    this->Kernels.gatherNear(bodies, this->Reach.data(), this->Candidates.data(), count, origin, near);
    std::uint32_t mine[runLength];
    const std::uint32_t length = this->AllRuns.first[run + 1] - first;
    std::iota(mine, mine + length, first);
    const NearColumns own = this->Own.columnsFor(length);
    this->Kernels.gatherNear(bodies, this->Reach.data(), mine, length, origin, own);
    for (std::uint32_t l = 0; l < length; ++l)
    {
      float numbers[NearColumns::count];
      for (int number = 0; number < NearColumns::count; ++number)
      {
        numbers[number] = own.numbers[std::size_t(number) * own.stride + l];
      }
      if (this->Room.size() < this->Size + count + width)
      {
        this->Room.resize(2 * (this->Size + count + width));
      }
      std::uint32_t* begin = this->Room.data() + this->Size;
      const std::uint32_t* end = this->Kernels.selectNeighbours(near, this->Candidates.data(), count, numbers, begin);
      counts[mine[l]] = static_cast<std::size_t>(end - begin);
      this->Size += counts[mine[l]];
      this->Pairs.add(counts[mine[l]]);
    }
  }

  /// What all runs since the last time have found, one after the other.
  std::vector<std::uint32_t> take()
  {
    const auto begin = this->Room.begin();
    std::vector<std::uint32_t> taken(begin, begin + static_cast<std::ptrdiff_t>(this->Size));
    this->Size = 0;
    return taken;
  }

private:
  /// Puts the capsules of other fibres whose boxes overlap the run's in increasing order into Candidates, and returns their
  /// number.
  std::size_t collect(std::size_t run)
  {
    const Box& box = this->AllRuns.boxes[run];
    const FourInts first = this->Grid.cellOf(box.lower);
    const FourInts last = this->Grid.cellOf(box.upper);
    const BoxColumns columns = this->Entries.columns();
    BoxQuery query = this->Grid.queryOf(box);
    this->findFibre(run);
    query.skipFrom = static_cast<std::uint32_t>(this->FibreBegin);
    query.skipTo = static_cast<std::uint32_t>(this->FibreEnd);
    std::size_t taken = 0;
    for (query.z = first[2]; query.z <= last[2]; ++query.z)
    {
      for (query.y = first[1]; query.y <= last[1]; ++query.y)
      {
        const std::size_t begin = this->Entries.start(this->Grid.index(first[0], query.y, query.z));
        const std::size_t end = this->Entries.start(this->Grid.index(last[0], query.y, query.z) + 1);
        this->Others.resize(std::max(this->Others.size(), taken + end - begin + width));
        const std::uint32_t* next = this->Kernels.selectBoxes(columns, begin, end, query, this->Others.data() + taken);
        taken = static_cast<std::size_t>(next - this->Others.data());
      }
    }
    this->Sorted.resize(this->Others.size());
    constexpr std::size_t few = 128; // beyond that the square of the count is what takes longer
    if (taken <= few)
    {
      this->Kernels.sortKeys(this->Others.data(), taken, this->Sorted.data());
    }
    else
    {
      const auto begin = this->Others.begin();
      std::sort(begin, begin + static_cast<std::ptrdiff_t>(taken));
      this->Others.swap(this->Sorted);
    }
    this->Candidates.resize(std::max(this->Candidates.size(), 8 * taken + width));
    const std::uint32_t* end = this->Kernels.selectFromRuns(
      this->AllRuns.blocks.get(), this->AllRuns.first.data(), this->Sorted.data(), taken, query, this->Candidates.data());
    return static_cast<std::size_t>(end - this->Candidates.data());
  }

  /// The runs of the run's fibre.
  void findFibre(std::size_t run)
  {
    if (this->FibreBegin <= run && run < this->FibreEnd)
    {
      return;
    }
    const auto fibreOf = [&](std::size_t i) { return this->Bodies.fibre[this->AllRuns.first[i]]; };
    this->FibreBegin = run;
    while (this->FibreBegin > 0 && fibreOf(this->FibreBegin - 1) == fibreOf(run))
    {
      --this->FibreBegin;
    }
    this->FibreEnd = run + 1;
    while (this->FibreEnd < this->AllRuns.size() && fibreOf(this->FibreEnd) == fibreOf(run))
    {
      ++this->FibreEnd;
    }
  }

  const Capsules& Bodies;
  const std::vector<float>& Reach;
  const Runs& AllRuns;
  const CellGrid& Grid;
  const CellEntries& Entries;
  Bound& Pairs;
  const VectorKernels& Kernels = vectorKernels();
  std::size_t FibreBegin = 0; ///< runs of the present fibre
  std::size_t FibreEnd = 0;
  std::vector<std::uint32_t> Others; ///< runs whose boxes overlap
  std::vector<std::uint32_t> Sorted;
  std::vector<std::uint32_t> Candidates; ///< capsules
  NearCapsules Near;
  NearCapsules Own;
  std::vector<std::uint32_t> Room; ///< what has been found, and room for more
  std::size_t Size = 0;
};

} // namespace

void findNeighbours(const Capsules& capsules, const std::vector<float>& reach, int threads, NeighbourList& list)
{
  const std::size_t count = capsules.size();
  list.offsets.assign(count + 1, 0);
  if (count == 0)
  {
    list.indices.clear();
    return;
  }
  Runs runs(capsules, reach, threads);
  constexpr std::size_t blockSize = 1024;
  const std::size_t blocks = (runs.size() + blockSize - 1) / blockSize;
  std::vector<std::vector<std::uint32_t>> found(blocks); // joined once all are known
  {
    const CellGrid grid(runs.boxes);
    const CellEntries entries(runs.boxes, grid, threads);
    Bound bound;
    Carrier carrier;
#pragma omp parallel num_threads(threads)
    {
      std::optional<RunSearch> search;
      carrier.run([&] { search.emplace(capsules, reach, runs, grid, entries, bound); });
#pragma omp for schedule(dynamic, 1)
      for (std::size_t block = 0; block < blocks; ++block)
      {
        if (carrier.failed())
        {
          continue;
        }
        carrier.run(
          [&]
          {
            const std::size_t end = std::min(runs.size(), (block + 1) * blockSize);
            for (std::size_t i = block * blockSize; i < end; ++i)
            {
              search->find(i, list.offsets.data() + 1);
            }
            found[block] = search->take();
          });
      }
    }
    carrier.rethrow();
    runs.blocks.reset();
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    list.offsets[k + 1] += list.offsets[k];
  }
  if (list.indices.capacity() < list.offsets[count])
  {
    std::vector<std::uint32_t>().swap(list.indices); // nothing in it is worth copying
  }
  list.indices.resize(list.offsets[count]);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::size_t block = 0; block < blocks; ++block)
  {
    const std::size_t begin = list.offsets[runs.first[block * blockSize]];
    std::copy(found[block].begin(), found[block].end(), list.indices.begin() + static_cast<std::ptrdiff_t>(begin));
    std::vector<std::uint32_t>().swap(found[block]);
  }
}

void findNeighbours(const Capsules& capsules, double reach, int threads, NeighbourList& list)
{
  findNeighbours(capsules, std::vector<float>(capsules.size(), static_cast<float>(0.5 * reach)), threads, list);
}

} // namespace cactus
