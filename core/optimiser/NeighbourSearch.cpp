// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/NeighbourSearch.h"

#include "base/Error.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "optimiser/CapsuleRuns.h"
#include "optimiser/RunGrid.h"
#include "optimiser/SearchKernels.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace cactus
{

namespace
{

/// Memory for the columns of capsules near a run.
class NearCapsules
{
public:
  NearColumns columnsFor(std::size_t count)
  {
    constexpr std::size_t multiple = SearchKernels::padding;
    const std::size_t padded = (count + multiple - 1) / multiple * multiple;
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

/// Counts the pairs that all threads find, and ends the search once they would not fit into memory: if very many fibres lie in
/// one place, pairs grow with the square of the number of fibres.
class PairLimit
{
public:
  PairLimit()
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
  /// Found pairs with their spare capacity, and the joined list.
  static constexpr std::size_t bytesPerPair = 4 * sizeof(std::uint32_t);
  const std::size_t Most;
  std::atomic<std::size_t> Found{ 0 };
};

/// The input of a search.
struct SearchedRuns
{
  const Capsules& capsules;
  const std::vector<float>& reach;
  const CapsuleRuns& runs;
  const RunGrid& grid;
  const RunGridEntries& entries;
  PairLimit& pairs;
};

/// Finds the neighbours of the capsules of one run after the other.
class RunSearch
{
public:
  explicit RunSearch(const SearchedRuns& all)
    : All(all)
  {
  }

  /// Sets counts[l] to the number of neighbours of the run's l-th capsule.
  void find(std::size_t run, std::size_t* counts)
  {
    const std::size_t count = this->collect(run);
    const std::uint32_t first = this->All.runs.first()[run];
    const std::uint32_t length = this->All.runs.first()[run + 1] - first;
    const double(&origin)[3] = this->All.capsules.bodies[first].p0;
    const NearColumns near = this->gather(this->Candidates.data(), count, origin, this->Near);
    std::uint32_t mine[CapsuleRuns::longest];
    std::iota(mine, mine + length, first);
    const NearColumns own = this->gather(mine, length, origin, this->Own);
    for (std::uint32_t l = 0; l < length; ++l)
    {
      float numbers[NearColumns::count];
      for (int number = 0; number < NearColumns::count; ++number)
      {
        numbers[number] = own.numbers[std::size_t(number) * own.stride + l];
      }
      const std::size_t needed = this->Size + count + SearchKernels::padding;
      if (this->Room.size() < needed)
      {
        this->Room.resize(2 * needed);
      }
      std::uint32_t* begin = this->Room.data() + this->Size;
      const std::uint32_t* end = this->Kernels.selectNeighbours(near, this->Candidates.data(), count, numbers, begin);
      counts[l] = static_cast<std::size_t>(end - begin);
      this->Size += counts[l];
      this->All.pairs.add(counts[l]);
    }
  }

  /// Returns the neighbours of all runs since the last call, one after the other.
  std::vector<std::uint32_t> take()
  {
    const auto begin = this->Room.begin();
    std::vector<std::uint32_t> taken(begin, begin + static_cast<std::ptrdiff_t>(this->Size));
    this->Size = 0;
    return taken;
  }

private:
  NearColumns gather(const std::uint32_t* indices, std::size_t count, const double (&origin)[3], NearCapsules& room) const
  {
    const NearColumns columns = room.columnsFor(count);
    this->Kernels.gatherNear(this->All.capsules.bodies.data(), this->All.reach.data(), indices, count, origin, columns);
    return columns;
  }

  /// Puts the capsules of other fibres whose boxes overlap the run's into Candidates, in increasing order, and returns their
  /// number.
  std::size_t collect(std::size_t run)
  {
    this->findFibre(run);
    BoxQuery query = this->All.grid.queryOf(this->All.runs.boxes()[run]);
    query.skipFrom = static_cast<std::uint32_t>(this->FibreBegin);
    query.skipTo = static_cast<std::uint32_t>(this->FibreEnd);
    const std::size_t taken = this->collectRuns(this->All.runs.boxes()[run], query);
    this->sortRuns(taken);
    this->Candidates.resize(std::max(this->Candidates.size(), 8 * taken + SearchKernels::padding));
    const std::uint32_t* end = this->Kernels.selectFromRuns(
      this->All.runs.blocks(), this->All.runs.first().data(), this->Sorted.data(), taken, query, this->Candidates.data());
    return static_cast<std::size_t>(end - this->Candidates.data());
  }

  /// Puts the runs of other fibres whose boxes overlap the box into Others, each once, and returns their number.
  std::size_t collectRuns(const RunBox& box, BoxQuery& query)
  {
    const Eigen::Array4i first = this->All.grid.cellOf(box.lower);
    const Eigen::Array4i last = this->All.grid.cellOf(box.upper);
    const BoxColumns columns = this->All.entries.columns();
    std::size_t taken = 0;
    for (query.z = first[2]; query.z <= last[2]; ++query.z)
    {
      for (query.y = first[1]; query.y <= last[1]; ++query.y)
      {
        const std::size_t begin = this->All.entries.start(this->All.grid.index(first[0], query.y, query.z));
        const std::size_t end = this->All.entries.start(this->All.grid.index(last[0], query.y, query.z) + 1);
        this->Others.resize(std::max(this->Others.size(), taken + end - begin + SearchKernels::padding));
        const std::uint32_t* next = this->Kernels.selectBoxes(columns, begin, end, query, this->Others.data() + taken);
        taken = static_cast<std::size_t>(next - this->Others.data());
      }
    }
    return taken;
  }

  /// Sorts the first `count` of Others into Sorted.
  void sortRuns(std::size_t count)
  {
    this->Sorted.resize(this->Others.size());
    constexpr std::size_t few = 128; // beyond that, quadratic sorting takes longer
    if (count <= few)
    {
      this->Kernels.sortKeys(this->Others.data(), count, this->Sorted.data());
      return;
    }
    const auto begin = this->Others.begin();
    std::sort(begin, begin + static_cast<std::ptrdiff_t>(count));
    this->Others.swap(this->Sorted);
  }

  /// Finds the runs of the run's fibre.
  void findFibre(std::size_t run)
  {
    if (this->FibreBegin <= run && run < this->FibreEnd)
    {
      return;
    }
    const auto fibreOf = [&](std::size_t i) { return this->All.capsules.fibre[this->All.runs.first()[i]]; };
    this->FibreBegin = run;
    while (this->FibreBegin > 0 && fibreOf(this->FibreBegin - 1) == fibreOf(run))
    {
      --this->FibreBegin;
    }
    this->FibreEnd = run + 1;
    while (this->FibreEnd < this->All.runs.size() && fibreOf(this->FibreEnd) == fibreOf(run))
    {
      ++this->FibreEnd;
    }
  }

  SearchedRuns All;
  const SearchKernels& Kernels = bestKernels<SearchKernels>();
  std::size_t FibreBegin = 0; ///< runs of the present fibre
  std::size_t FibreEnd = 0;
  std::vector<std::uint32_t> Others; ///< runs whose boxes overlap
  std::vector<std::uint32_t> Sorted;
  std::vector<std::uint32_t> Candidates; ///< capsules
  NearCapsules Near;
  NearCapsules Own;
  std::vector<std::uint32_t> Room; ///< neighbours found, and spare room
  std::size_t Size = 0;
};

/// Consecutive runs.
struct RunRange
{
  std::size_t begin;
  std::size_t end;
};

/// Returns the runs of some capsules, which are whole fibres.
RunRange runsOf(const CapsuleRuns& runs, const CapsuleRange& capsules)
{
  const auto runAt = [&](std::size_t capsule) {
    return static_cast<std::size_t>(std::lower_bound(runs.first().begin(), runs.first().end(), capsule) - runs.first().begin());
  };
  return { runAt(capsules.begin), runAt(capsules.end) };
}

/// Searches for the neighbours of the capsules of some runs. Sets counts[l] to their number for the l-th of these capsules, and
/// returns the neighbours per block of runs.
std::vector<std::vector<std::uint32_t>> searchAll(const Capsules& capsules, const std::vector<float>& reach,
  const CapsuleRuns& runs, const RunRange& of, int threads, std::size_t* counts)
{
  const RunGrid grid(runs.boxes());
  const RunGridEntries entries(runs.boxes(), grid, threads);
  PairLimit pairs;
  std::vector<std::vector<std::uint32_t>> found((of.end - of.begin + runsTogether - 1) / runsTogether);
  Context context;
  context.threads = threads;
  parallelForWithWorkers(
    found.size(), context,
    [&](int) {
      return RunSearch({ capsules, reach, runs, grid, entries, pairs });
    },
    [&](RunSearch& search, std::size_t block)
    {
      const std::size_t end = std::min(of.end, of.begin + (block + 1) * runsTogether);
      for (std::size_t i = of.begin + block * runsTogether; i < end; ++i)
      {
        search.find(i, counts + (runs.first()[i] - runs.first()[of.begin]));
      }
      found[block] = search.take();
    });
  return found;
}

} // namespace

void findNeighbours(
  const Capsules& capsules, const CapsuleRange& of, const std::vector<float>& reach, int threads, NeighbourList& list)
{
  const std::size_t count = of.size();
  list.offsets.assign(count + 1, 0);
  if (count == 0)
  {
    list.indices.clear();
    return;
  }
  std::vector<std::vector<std::uint32_t>> found;
  std::vector<std::size_t> firstOfBlock; // index among the capsules `of`
  {
    const CapsuleRuns runs(capsules, reach, threads);
    const RunRange range = runsOf(runs, of);
    found = searchAll(capsules, reach, runs, range, threads, list.offsets.data() + 1);
    for (std::size_t run = range.begin; run < range.end; run += runsTogether)
    {
      firstOfBlock.push_back(runs.first()[run] - of.begin);
    }
  }
  std::partial_sum(list.offsets.begin(), list.offsets.end(), list.offsets.begin());
  if (list.indices.capacity() < list.offsets[count])
  {
    std::vector<std::uint32_t>().swap(list.indices); // the old content need not be copied
  }
  list.indices.resize(list.offsets[count]);
  parallelForInBlocks(found.size(), 1, threads,
    [&](std::size_t block)
    {
      const auto begin = static_cast<std::ptrdiff_t>(list.offsets[firstOfBlock[block]]);
      std::copy(found[block].begin(), found[block].end(), list.indices.begin() + begin);
      std::vector<std::uint32_t>().swap(found[block]);
    });
}

void findNeighbours(const Capsules& capsules, const std::vector<float>& reach, int threads, NeighbourList& list)
{
  findNeighbours(capsules, { 0, capsules.size() }, reach, threads, list);
}

void findNeighbours(const Capsules& capsules, double reach, int threads, NeighbourList& list)
{
  findNeighbours(capsules, std::vector<float>(capsules.size(), static_cast<float>(0.5 * reach)), threads, list);
}

} // namespace cactus
