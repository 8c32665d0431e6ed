// SPDX-License-Identifier: BSD-3-Clause
#include "base/Parallel.h"

#include <gtest/gtest.h>

#include <atomic>
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
  // Only the caller's thread asks. Here the other one may well do everything before that thread has its first turn.
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
