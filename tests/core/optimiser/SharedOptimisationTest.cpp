// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: an optimisation that processes share ends with the bits of a single process, in all of them, on any number of
// threads: fibres, table and checkpoint; a killed one continues, on another number of processes; it can be stopped in any of
// them, and an error of one ends all.
#include "BundleBetweenWalls.h"
#include "optimiser/CapsuleOptimizer.h"

#include "../ThreadTeam.h"
#include "RandomBundle.h"
#include "ScratchPath.h"
#include "base/Bytes.h"
#include "base/Error.h"
#include "bundle/BundleInitializer.h"
#include "fibres/FibreOrder.h"
#include "optimiser/CoarseFibres.h"
#include "optimiser/FibreShares.h"
#include "optimiser/OverlapReport.h"
#include "optimiser/SharedCapsules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <string>

namespace
{

using namespace cactus;
using cactus_testing::contentOf;
using cactus_testing::inTeam;
using cactus_testing::scratchPath;

/// Returns the result of an optimisation, without its effort.
std::string bytesOfResult(const Fibres& fibres, const OptimisationResult& result)
{
  ByteWriter put;
  put(result.reason);
  put.addAll(fibres.points.data(), fibres.points.size());
  put(fibres.radii);
  put(result.overlap);
  put(result.maximumPenetration);
  put(static_cast<std::uint64_t>(result.overlappingPairs));
  for (const ConvergenceRow& row : result.convergence)
  {
    put(row.iteration);
    put(static_cast<std::uint64_t>(row.overlappingPairs));
    for (const double value :
      { row.overlapCost, row.maximumPenetration, row.curvatureCost, row.lengthCost, row.radiusCost, row.compactnessCost })
    {
      put(value);
    }
  }
  return put.bytes();
}

std::string optimised(Fibres fibres, const CapsuleOptimizerOptions& options, int threads, Team* team)
{
  Context context;
  context.threads = threads;
  const OptimisationResult result = optimise(fibres, options, context, {}, team);
  ByteWriter put;
  put(result.pairEvaluations);
  put(result.neighbourSearches);
  return bytesOfResult(fibres, result) + put.bytes();
}

void expectTheSameOnAnyNumberOfProcesses(const Fibres& fibres, const CapsuleOptimizerOptions& options)
{
  const std::string alone = optimised(fibres, options, 1, nullptr);
  for (const int size : { 1, 2, 3, 4 })
  {
    const auto found = inTeam(size, [&](Team& team) { return optimised(fibres, options, 1 + team.place() % 2, &team); });
    for (const std::string& one : found)
    {
      ASSERT_TRUE(one == alone) << size << " processes: " << (one.size() < 200 ? one : "other bits");
    }
  }
}

Fibres smallBundle(double side)
{
  BundleBetweenWalls options;
  options.side = side;
  options.meanDispersion = 10.0;
  return initialiseBundles(options);
}

TEST(SharedOptimisation, HasTheSameBitsOnAnyNumberOfProcessesAndThreads)
{
  expectTheSameOnAnyNumberOfProcesses(smallBundle(9.0), {});
  CapsuleOptimizerOptions options;
  options.maximumIterations = 40;
  options.radiusTolerance = 0.02;
  for (const auto method : { DescentMethod::Momentum, DescentMethod::Adagrad })
  {
    options.method = method;
    options.stepSize = method == DescentMethod::Momentum ? 1.0 : 0.02;
    expectTheSameOnAnyNumberOfProcesses(randomBundle(13, 150, 30, 12.0, 0.1), options);
  }
}

// Coinciding fibres get their direction by FibreId, even if they belong to different processes.
TEST(SharedOptimisation, PartsFibresOfSeveralProcessesThatCoincide)
{
  Fibres fibres = smallBundle(5.0);
  for (std::size_t f = 0; f + 1 < fibres.size(); f += 2)
  {
    const std::size_t count = std::min(fibres.pointCount(f), fibres.pointCount(f + 1));
    for (std::size_t i = 0; i < count; ++i)
    {
      fibres.points[fibres.offsets[f + 1] + i] = fibres.points[fibres.offsets[f] + i];
    }
    std::reverse(
      fibres.points.begin() + std::ptrdiff_t(fibres.offsets[f]), fibres.points.begin() + std::ptrdiff_t(fibres.offsets[f + 1]));
  }
  CapsuleOptimizerOptions options;
  options.maximumIterations = 60;
  expectTheSameOnAnyNumberOfProcesses(fibres, options);
}

TEST(SharedOptimisation, WorksWithFewerFibresThanProcesses)
{
  for (const int count : { 1, 2, 3 })
  {
    expectTheSameOnAnyNumberOfProcesses(randomBundle(7, count, 12, 1.0, 0.1), {});
  }
}

TEST(SharedOptimisation, LeavesAGoodStateAlone)
{
  expectTheSameOnAnyNumberOfProcesses(randomBundle(3, 2, 12, 60.0, 0.0), {});
}

TEST(SharedCapsules, HaveTheNeighboursThatOneProcessFinds)
{
  const Fibres given = smallBundle(14.0);
  const Fibres all = FibreOrder(given).ordered(given);
  const Capsules capsules = capsulesOf(all);
  std::vector<float> reach(capsules.size());
  for (std::size_t k = 0; k < reach.size(); ++k)
  {
    reach[k] = 0.05f + 0.02f * static_cast<float>(k % 7);
  }
  NeighbourList expected;
  findNeighbours(capsules, reach, 2, expected);
  for (const int size : { 2, 3, 4 })
  {
    const auto told = inTeam(size,
      [&](Team& team)
      {
        const Sharing sharing(&team);
        const FibreShares shares(all, sharing);
        const Fibres own = shares.own(all);
        SharedCapsules shared(own, shares);
        const auto begin = reach.begin() + std::ptrdiff_t(shares.ownCapsule());
        NeighbourList list;
        // Again from the state that a search has left.
        for (int i = 0; i < 2; ++i)
        {
          sharing.together(
            [&] { shared.findNeighbours(own, std::vector<float>(begin, begin + std::ptrdiff_t(shared.own().size())), 1, list); });
        }
        const std::size_t first = expected.offsets[shares.ownCapsule()];
        bool same = true;
        for (std::size_t k = 0; k <= shared.own().size(); ++k)
        {
          same = same && list.offsets[k] + first == expected.offsets[shares.ownCapsule() + k];
        }
        for (std::size_t n = 0; same && n < list.indices.size(); ++n)
        {
          const Capsule& mine = shared.all().bodies[list.indices[n]];
          same = std::memcmp(&mine, &capsules.bodies[expected.indices[first + n]], sizeof(Capsule)) == 0;
        }
        return same ? std::to_string(shared.all().size()) : "other neighbours";
      });
    for (const std::string& known : told)
    {
      ASSERT_NE(known, "other neighbours") << size;
      EXPECT_LT(std::stoul(known), capsules.size()) << size;
    }
  }
}

TEST(FibreShares, HaveAboutAsManyCapsules)
{
  const Fibres fibres = smallBundle(12.0);
  for (const int size : { 1, 2, 3, 4, 7 })
  {
    inTeam(size,
      [&](Team& team)
      {
        const Sharing sharing(&team);
        const FibreShares shares(fibres, sharing);
        EXPECT_EQ(shares.capsuleCount(), fibres.points.size() - fibres.size());
        for (int process = 0; process < size; ++process)
        {
          const auto own = static_cast<double>(shares.capsuleBegin(process + 1) - shares.capsuleBegin(process));
          EXPECT_NEAR(own, static_cast<double>(shares.capsuleCount()) / size, 60.0);
          EXPECT_EQ(shares.pointBegin(process), fibres.offsets[shares.fibreBegin(process)]);
        }
        return std::string();
      });
  }
}

/// Returns a checkpoint without its clock values and checksum.
std::string withoutClock(std::string bytes, std::size_t points)
{
  std::size_t at = 20 + 8 + 8;
  std::int32_t iterations = 0;
  std::memcpy(&iterations, bytes.data() + at, 4);
  const auto clear = [&](std::size_t place) { std::fill_n(bytes.begin() + std::ptrdiff_t(place), 8, '\0'); };
  clear(at += 4 + 1); // behind the flag for fewer control points
  at += 4 * 8 + 4 + 8;
  for (std::int32_t i = 0; i < iterations; ++i)
  {
    clear(at + 4 + 7 * 8);
    at += 4 + 8 * 8;
  }
  at += (24 + 8) * points + 8 + 8 + 4;
  clear(at);
  clear(at + 8);
  clear(bytes.size() - 8);
  return bytes;
}

TEST(SharedOptimisation, WritesTheSameCheckpoint)
{
  const std::string path = scratchPath("shared-checkpoint");
  for (const double tolerance : { 0.0, 0.02 })
  {
    for (const int iterations : { 1, 3, 14, 17, 75 })
    {
      const Fibres fibres = smallBundle(7.0);
      // If radii change, all control points are there from the start, else after some fifty iterations.
      const bool isCoarse = tolerance == 0.0 && iterations < 75;
      const std::size_t points = isCoarse ? CoarseFibres(fibres).fibres().points.size() : fibres.points.size();
      CapsuleOptimizerOptions options;
      options.radiusTolerance = tolerance;
      options.maximumIterations = iterations;
      options.checkpointFile = path;
      std::string expected;
      for (const int size : { 1, 2, 3, 4 })
      {
        std::remove(path.c_str());
        inTeam(size, [&](Team& team) { return optimised(fibres, options, 1, &team); });
        const std::string found = withoutClock(contentOf(path), points);
        expected = size == 1 ? found : expected;
        ASSERT_GT(found.size(), 80 * points);
        ASSERT_EQ(found[20 + 2 * 8 + 4], isCoarse ? 1 : 0);
        ASSERT_TRUE(found == expected) << size << " processes, " << iterations << " iterations";
      }
    }
  }
  std::remove(path.c_str());
}

TEST(SharedOptimisation, GoesOnWithAnotherNumberOfProcesses)
{
  const std::string path = scratchPath("shared-resumed");
  const Fibres fibres = smallBundle(7.0);
  CapsuleOptimizerOptions options;
  options.radiusTolerance = 0.02;
  Fibres moved = fibres;
  Context alone;
  const OptimisationResult inOneGo = optimise(moved, options, alone);
  const std::string whole = bytesOfResult(moved, inOneGo);
  options.checkpointFile = path;
  options.checkpointInterval = 0.0;
  options.resume = true;
  for (const std::vector<int>& sizes : { std::vector<int>{ 2, 1 }, { 2, 3 }, { 1, 4 }, { 4, 2, 3 } })
  {
    std::remove(path.c_str());
    int until = 0;
    for (const int size : sizes)
    {
      until += 12;
      const bool isLast = size == sizes.back();
      const auto found = inTeam(size,
        [&](Team& team)
        {
          Fibres part = fibres;
          Context context;
          context.threads = 1;
          // The last process is killed during its work; the checkpoint is that of the iteration before.
          const auto observe = [&](const ConvergenceRow& row, const Fibres&)
          {
            if (!isLast && row.iteration == until && team.place() == size - 1)
            {
              throw std::runtime_error("killed");
            }
          };
          const OptimisationResult result = optimise(part, options, context, observe, &team);
          return bytesOfResult(part, result);
        });
      for (const std::string& one : found)
      {
        if (isLast)
        {
          ASSERT_TRUE(one == whole) << size << (one.size() < 200 ? one : " other bits");
        }
        else
        {
          ASSERT_NE(one.find("killed"), std::string::npos);
        }
      }
    }
  }
  std::remove(path.c_str());
}

TEST(SharedOptimisation, RefusesADamagedCheckpointOnce)
{
  const std::string path = scratchPath("shared-damaged");
  const Fibres fibres = smallBundle(5.0);
  CapsuleOptimizerOptions options;
  options.maximumIterations = 3;
  options.checkpointFile = path;
  inTeam(2, [&](Team& team) { return optimised(fibres, options, 1, &team); });
  std::string bytes = contentOf(path);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(path, std::ios::binary) << bytes;
  options.resume = true;
  const auto told = inTeam(2,
    [&](Team& team)
    {
      try
      {
        optimised(fibres, options, 1, &team);
      }
      catch (const ReportedElsewhere&)
      {
        return std::string("reported elsewhere");
      }
      catch (const FileError& error)
      {
        return std::string(error.what());
      }
      return std::string("well");
    });
  EXPECT_EQ(told[0].find("CheckpointFile " + path + " is damaged"), 0u) << told[0];
  EXPECT_EQ(told[1], "reported elsewhere");
  std::remove(path.c_str());
}

// A later checkpoint that cannot be written is recorded, and does not stop the run.
TEST(SharedOptimisation, GoesOnWithoutALaterCheckpoint)
{
  const std::string path = scratchPath("shared-thesis");
  std::remove(path.c_str());
  const Fibres fibres = smallBundle(5.0);
  CapsuleOptimizerOptions options;
  options.checkpointFile = path;
  options.checkpointInterval = 0.0;
  const auto told = inTeam(3,
    [&](Team& team)
    {
      Fibres own = fibres;
      const auto observe = [&](const ConvergenceRow& row, const Fibres&)
      {
        if (row.iteration == 2 && team.place() == 0)
        {
          std::ofstream(path, std::ios::binary) << "my thesis, until now safe here\n";
        }
      };
      const OptimisationResult result = optimise(own, options, {}, observe, &team);
      return result.reason == StopReason::Converged ? result.checkpointFailure : "not converged";
    });
  EXPECT_NE(told[0].find("not a checkpoint of this program, and is kept"), std::string::npos) << told[0];
  EXPECT_EQ(told[1], "");
  EXPECT_EQ(contentOf(path), "my thesis, until now safe here\n");
  std::remove(path.c_str());
}

TEST(SharedOptimisation, StopsWhereAnyProcessWantsIt)
{
  for (const int place : { 0, 1, 2 })
  {
    const auto told = inTeam(3,
      [&](Team& team)
      {
        Fibres fibres = randomBundle(14, 40, 12, 6.0, 0.0);
        int calls = 0;
        Context context;
        context.cancelled = [&] { return ++calls > 5 && team.place() == place; };
        const OptimisationResult result = optimise(fibres, {}, context, {}, &team);
        EXPECT_EQ(result.reason, StopReason::Stopped);
        return bytesOfResult(fibres, result) + std::to_string(result.convergence.size());
      });
    EXPECT_EQ(told[0].back(), '6');
    EXPECT_TRUE(told[0] == told[1] && told[0] == told[2]);
  }
}

// The clocks of processes differ: the first one's counts.
TEST(SharedOptimisation, EndsItsTimeInAllProcessesAtOnce)
{
  CapsuleOptimizerOptions options;
  options.timeBudget = 0.05;
  options.overlapTolerance = 1e-9;
  options.maximumIterations = 1000000;
  const auto told = inTeam(3, [&](Team& team) { return optimised(smallBundle(8.0), options, 1, &team); });
  EXPECT_TRUE(told[0] == told[1] && told[0] == told[2]);
  options.timeBudget = 1e-6;
  const auto reasons = inTeam(3,
    [&](Team& team)
    {
      Fibres fibres = smallBundle(8.0);
      return std::to_string(int(optimise(fibres, options, {}, {}, &team).reason));
    });
  EXPECT_EQ(reasons, std::vector<std::string>(3, std::to_string(int(StopReason::TimeBudget))));
}

TEST(SharedOptimisation, ShowsEveryStateToWhoeverLooks)
{
  const Fibres start = smallBundle(5.0);
  std::string expected;
  const auto looking = [&](std::string& seen)
  {
    return [&seen](const ConvergenceRow& row, const Fibres& state)
    {
      ByteWriter put;
      put(row.iteration);
      put(row.seconds >= 0.0 ? row.overlapCost : -1.0);
      put.addAll(state.points.data(), state.points.size());
      seen += put.bytes();
    };
  };
  CapsuleOptimizerOptions options;
  options.maximumIterations = 15;
  Fibres alone = start;
  optimise(alone, options, {}, looking(expected));
  const auto told = inTeam(3,
    [&](Team& team)
    {
      Fibres fibres = start;
      std::string seen;
      std::function<void(const ConvergenceRow&, const Fibres&)> observe;
      if (team.place() == 1)
      {
        observe = looking(seen);
      }
      optimise(fibres, options, {}, observe, &team);
      return seen;
    });
  EXPECT_EQ(told[0], "");
  EXPECT_TRUE(told[1] == expected);
}

TEST(SharedOptimisation, RefusesProcessesThatWereGivenSomethingElse)
{
  const auto told = inTeam(2,
    [&](Team& team)
    {
      Fibres fibres = smallBundle(5.0);
      CapsuleOptimizerOptions options;
      options.maximumIterations = 5 + team.place();
      return optimised(fibres, options, 1, &team);
    });
  EXPECT_EQ(told[0].find("the ranks of this run were given different fibres or parameters"), 0u) << told[0];
}

TEST(SharedOptimisation, EndsInAllWhereOneFails)
{
  const auto told = inTeam(3,
    [&](Team& team)
    {
      Fibres fibres = smallBundle(5.0);
      Context context;
      context.progress = [&](double, const std::string&)
      {
        if (team.place() == 2)
        {
          throw FileError("no space");
        }
      };
      try
      {
        optimise(fibres, {}, context, {}, &team);
      }
      catch (const ReportedElsewhere&)
      {
        return std::string("reported elsewhere");
      }
      catch (const FileError& error)
      {
        return std::string(error.what());
      }
      return std::string("well");
    });
  EXPECT_EQ(told, (std::vector<std::string>{ "on rank 2: no space", "reported elsewhere", "reported elsewhere" }));
}

} // namespace
