// SPDX-License-Identifier: BSD-3-Clause
#include "base/Threads.h"

#include "base/Error.h"

#include <omp.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

/// Sets how long a waiting thread holds its core (ms); from LLVM's OpenMP library.
extern "C" void kmp_set_blocktime(int milliseconds);

namespace cactus
{

namespace
{

thread_local int started = 1;

/// How many of `wanted` threads, the calling one included, the system lets this process have at the same time. The OpenMP library
/// ends the process where it cannot start one.
int startableThreads(int wanted)
{
  std::mutex gate;
  std::vector<std::thread> probes;
  {
    const std::lock_guard<std::mutex> closed(gate);
    try
    {
      while (static_cast<int>(probes.size()) + 1 < wanted)
      {
        probes.emplace_back([&gate] { const std::lock_guard<std::mutex> open(gate); });
      }
    }
    catch (const std::exception&)
    {
      // There is no room for another stack, or a limit on the number of threads.
    }
  }
  for (std::thread& probe : probes)
  {
    probe.join();
  }
  return static_cast<int>(probes.size()) + 1;
}

} // namespace

int processorCount()
{
  return omp_get_num_procs();
}

int usualThreadCount()
{
  const char* value = std::getenv("OMP_NUM_THREADS");
  if (value == nullptr || *value == '\0')
  {
    return processorCount();
  }
  char* end = nullptr;
  const long count = std::strtol(value, &end, 10);
  if (end == value || (*end != '\0' && *end != ',') || count < 1)
  {
    throw InvalidInput(text(
      "the environment variable OMP_NUM_THREADS is '", value, "': set it to a number of threads from 1 upwards, or unset it"));
  }
  return static_cast<int>(std::min<long>(count, 1 << 20));
}

int startedThreads()
{
  return started;
}

int startThreads(int wanted)
{
  if (wanted > started)
  {
    // Threads that wait sleep at once. The library's default holds their cores for 200 ms, which beside other programs makes a
    // small bundle many times slower.
    kmp_set_blocktime(0);
    started = startableThreads(wanted);
    // They are started now, since later there may be less room. The library keeps them.
    shareWork(started, [](int) {});
  }
  return std::min(wanted, started);
}

bool isAtSharedWork()
{
  return omp_in_parallel() != 0;
}

void shareWork(int threads, const std::function<void(int)>& work)
{
  if (isAtSharedWork() || startThreads(threads) < 2)
  {
    work(0);
    return;
  }
#pragma omp parallel num_threads(std::min(threads, started))
  work(omp_get_thread_num());
}

} // namespace cactus
