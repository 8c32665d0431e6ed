// SPDX-License-Identifier: BSD-3-Clause
#include "base/Parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

TEST(Parallel, RunsEachIndexOnce)
{
  for (const int threads : { 1, 2, 4 })
  {
    cactus::Context context;
    context.threads = threads;
    std::vector<int> runs(1000, 0);
    cactus::parallelFor(runs.size(), context, [&](std::size_t i) { ++runs[i]; });
    EXPECT_EQ(runs, std::vector<int>(1000, 1));
  }
}

TEST(Parallel, ThrowsWhatTheSmallestIndexThrew)
{
  cactus::Context context;
  context.threads = 1;
  try
  {
    cactus::parallelFor(10, context, [](std::size_t i) { i >= 4 ? throw i : void(); });
    ADD_FAILURE() << "nothing was thrown";
  }
  catch (const std::size_t index)
  {
    EXPECT_EQ(index, 4u);
  }
}

TEST(Parallel, DoesNothingForACallerThatHasAlreadyStopped)
{
  cactus::Context context;
  context.threads = 2;
  context.cancelled = [] { return true; };
  std::atomic<int> runs{ 0 };
  EXPECT_THROW(cactus::parallelFor(5, context, [&](std::size_t) { ++runs; }), cactus::Cancelled);
  EXPECT_EQ(runs, 0);
}

TEST(Parallel, HearsOfAStopThatComesWhileOtherThreadsDoTheWork)
{
  // Only the caller's thread asks. Here the other one may do everything before that thread has its first turn.
  const std::thread::id caller = std::this_thread::get_id();
  for (int repeat = 0; repeat < 200; ++repeat)
  {
    std::atomic<bool> wanted{ false };
    cactus::Context context;
    context.threads = 2;
    context.cancelled = [&]
    {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      return wanted.load();
    };
    EXPECT_THROW(cactus::parallelFor(2, context, [&](std::size_t) { wanted = true; }), cactus::Cancelled);
  }
}

TEST(Parallel, GivesEachThreadAWorkerOfItsOwn)
{
  struct Worker
  {
    int thread;
    std::size_t runs;
  };
  for (const int threads : { 1, 3 })
  {
    cactus::Context context;
    context.threads = threads;
    std::vector<std::atomic<int>> made(static_cast<std::size_t>(threads));
    std::vector<std::size_t> last(static_cast<std::size_t>(threads), 0);
    std::atomic<std::size_t> runs{ 0 };
    cactus::parallelForWithWorkers(
      500, context,
      [&](int thread)
      {
        ++made[static_cast<std::size_t>(thread)];
        return Worker{ thread, 0 };
      },
      [&](Worker& worker, std::size_t)
      {
        ++runs;
        // The worker's earlier counts are still there.
        EXPECT_EQ(worker.runs++, last[static_cast<std::size_t>(worker.thread)]++);
      });
    EXPECT_EQ(runs, 500u);
    for (const std::atomic<int>& times : made)
    {
      EXPECT_LE(times, 1);
    }
  }
}

TEST(Parallel, ThrowsWhatAWorkerCouldNotBeMadeOf)
{
  cactus::Context context;
  context.threads = 2;
  std::atomic<int> runs{ 0 };
  const auto fail = [](int) -> int { throw cactus::OutOfMemory("no room"); };
  EXPECT_THROW(cactus::parallelForWithWorkers(10, context, fail, [&](int, std::size_t) { ++runs; }), cactus::OutOfMemory);
  EXPECT_EQ(runs, 0);
}

TEST(Parallel, ReportsProgressInHundredths)
{
  cactus::Context context;
  context.threads = 1;
  std::vector<double> fractions;
  context.progress = [&](double fraction, const std::string&) { fractions.push_back(fraction); };
  cactus::parallelFor(
    10000, context, [](std::size_t) {}, "working", 0.5, 0.7);
  ASSERT_FALSE(fractions.empty());
  EXPECT_GE(fractions.size(), 99u);
  EXPECT_LE(fractions.size(), 101u);
  EXPECT_GT(fractions.front(), 0.5);
  EXPECT_DOUBLE_EQ(fractions.back(), 0.7);
}

TEST(Parallel, CutsThreadsWorkIntoBlocks)
{
  for (const int threads : { 1, 2 })
  {
    for (const std::size_t count : { 0, 1, 9, 10, 11, 1000 })
    {
      std::vector<int> runs(count, 0);
      std::atomic<std::size_t> blocks{ 0 };
      cactus::parallelBlocks(count, 10, threads,
        [&](std::size_t block, std::size_t begin, std::size_t end)
        {
          ++blocks;
          EXPECT_EQ(begin, 10 * block);
          EXPECT_TRUE(end == begin + 10 || (end == count && end > begin));
          for (std::size_t i = begin; i < end; ++i)
          {
            ++runs[i];
          }
        });
      cactus::parallelForInBlocks(count, 7, threads, [&](std::size_t i) { ++runs[i]; });
      EXPECT_EQ(blocks, (count + 9) / 10);
      EXPECT_EQ(runs, std::vector<int>(count, 2));
    }
  }
}

TEST(Parallel, ThrowsOutOfThreadsBlocksWhatTheFirstOneThrew)
{
  try
  {
    cactus::parallelForInBlocks(100, 10, 1, [](std::size_t i) { i % 10 == 5 ? throw i : void(); });
    ADD_FAILURE() << "no exception";
  }
  catch (const std::size_t index)
  {
    EXPECT_EQ(index, 5u);
  }
}
