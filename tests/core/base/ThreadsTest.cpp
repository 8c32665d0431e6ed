// SPDX-License-Identifier: BSD-3-Clause
#include "base/Threads.h"

#include "ChildProcess.h"
#include "base/Error.h"
#include "base/Parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace
{

/// Tells whether the sums of a thousand short loops in sequence are right, each with the threads of the calling one.
bool loopsAreRight(int threads, int loops)
{
  std::vector<int> numbers(37, 0);
  for (int loop = 0; loop < loops; ++loop)
  {
    cactus::parallelForInBlocks(numbers.size(), 2, threads, [&](std::size_t i) { numbers[i] += static_cast<int>(i); });
  }
  const std::size_t last = numbers.size() - 1;
  return std::accumulate(numbers.begin(), numbers.end(), 0) == loops * static_cast<int>(last * (last + 1) / 2);
}

/// Tells whether all threads of this process but the calling one are asleep (proc(5): state S).
bool othersSleep()
{
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task"))
  {
    if (entry.path().filename() == std::to_string(::syscall(SYS_gettid)))
    {
      continue;
    }
    std::string line;
    std::getline(std::ifstream(entry.path() / "stat"), line);
    if (line.substr(line.rfind(')') + 1, 2) != " S")
    {
      return false;
    }
  }
  return true;
}

/// Sets OMP_NUM_THREADS during its life.
class ThreadsVariable
{
public:
  explicit ThreadsVariable(const char* value)
  {
    const char* before = std::getenv("OMP_NUM_THREADS");
    this->WasSet = before != nullptr;
    this->Before = this->WasSet ? before : "";
    ::setenv("OMP_NUM_THREADS", value, 1);
  }
  ~ThreadsVariable() { this->WasSet ? ::setenv("OMP_NUM_THREADS", this->Before.c_str(), 1) : ::unsetenv("OMP_NUM_THREADS"); }

private:
  bool WasSet;
  std::string Before;
};

} // namespace

// Guarantees 5 and 4: a result never depends on the number of threads, so fewer are used if the requested ones cannot be started.
TEST(Threads, AreNeverMoreThanAreOfUse)
{
  cactus::Context context;
  for (const int asked : { 1, 2, 16, 17, 1000, 2000000000 })
  {
    context.threads = asked;
    EXPECT_EQ(context.threadCount(), std::min(asked, std::max(16, cactus::processorCount())));
  }
  context.threads = 0;
  EXPECT_LE(context.threadCount(), std::max(16, cactus::processorCount()));
}

TEST(Threads, AreAsManyAsTheEnvironmentSays)
{
  for (const auto& [value, count] : { std::pair("3", 3), std::pair("2,4", 2), std::pair("", cactus::processorCount()) })
  {
    const ThreadsVariable variable(value);
    EXPECT_EQ(cactus::usualThreadCount(), count) << value;
    EXPECT_EQ(cactus::Context().threadCount(), std::min(count, std::max(16, cactus::processorCount()))) << value;
  }
  for (const char* value : { "0", "-2", "many", "3x" })
  {
    const ThreadsVariable variable(value);
    EXPECT_THROW(cactus::usualThreadCount(), cactus::InvalidInput) << value;
  }
}

TEST(Threads, DoShortLoopsOneAfterTheOther)
{
  for (const int threads : { 2, 5, 3, 1, 5 })
  {
    EXPECT_TRUE(loopsAreRight(threads, 2000)) << threads;
  }
}

TEST(Threads, OfSeveralCallersDoNotMeet)
{
  std::atomic<int> right{ 0 };
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 3; ++caller)
  {
    callers.emplace_back([&] { right += loopsAreRight(3, 500) ? 1 : 0; });
  }
  for (std::thread& caller : callers)
  {
    caller.join();
  }
  EXPECT_EQ(right, 3);
}

TEST(Threads, AtSharedWorkShareNoMore)
{
  std::vector<int> runs(40 * 40, 0);
  std::atomic<int> strangers{ 0 };
  cactus::parallelForInBlocks(40, 1, 4,
    [&](std::size_t i)
    {
      EXPECT_TRUE(cactus::isAtSharedWork());
      const std::thread::id mine = std::this_thread::get_id();
      cactus::parallelForInBlocks(40, 1, 4,
        [&](std::size_t j)
        {
          ++runs[40 * i + j];
          strangers += std::this_thread::get_id() != mine ? 1 : 0;
        });
    });
  EXPECT_FALSE(cactus::isAtSharedWork());
  EXPECT_EQ(runs, std::vector<int>(runs.size(), 1));
  EXPECT_EQ(strangers, 0);
}

// A waiting thread must not use processor time.
TEST(Threads, SleepWhenThereIsNothingToDo)
{
  EXPECT_TRUE(loopsAreRight(cactus::processorCount(), 100));
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!othersSleep() && std::chrono::steady_clock::now() < end)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(othersSleep());
}

// Python's multiprocessing forks.
TEST(LoopsInAChild, AreSharedAnew)
{
  EXPECT_TRUE(loopsAreRight(3, 100));
  EXPECT_EQ(cactus_testing::inChild([] { return std::string(loopsAreRight(3, 100) ? "right" : "wrong"); }), "right");
  EXPECT_TRUE(loopsAreRight(3, 100));
}
