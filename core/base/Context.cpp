// SPDX-License-Identifier: BSD-3-Clause
#include "base/Context.h"

#include "base/Error.h"
#include "base/Memory.h"

#include <omp.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace cactus
{

namespace
{

/// How many of `wanted` threads, the calling one included, the system lets this process have at the same time.
int startableThreads(int wanted)
{
  std::mutex gate;
  std::vector<std::thread> probes;
  {
    const std::lock_guard<std::mutex> closed(gate);
    try
    {
      probes.reserve(static_cast<std::size_t>(wanted));
      while (static_cast<int>(probes.size()) + 1 < wanted)
      {
        probes.emplace_back([&gate] { const std::lock_guard<std::mutex> open(gate); });
      }
    }
    catch (const std::exception&)
    {
      // No room for another stack, or a limit on the number of threads.
    }
  }
  for (std::thread& probe : probes)
  {
    probe.join();
  }
  return static_cast<int>(probes.size()) + 1;
}

} // namespace

int Context::threadCount() const
{
  constexpr int always = 16;
  const int asked = threads > 0 ? threads : omp_get_max_threads();
  int count = std::min(asked, std::max(omp_get_num_procs(), always));
  if (omp_in_parallel() != 0)
  {
    return count;
  }
  // The OpenMP library ends the process where it cannot start a thread. So it is tried out first, and the library then has to
  // start them at once, since later there may be less room: it keeps them for the regions to come.
  thread_local int started = 1;
  if (count > started)
  {
    // A stack and an arena of malloc each; where address space is limited, half of it is for the work.
    constexpr double each = 80e6;
    count = static_cast<int>(std::clamp(0.5 * static_cast<double>(availableAddressSpace()) / each, 1.0, double(count)));
    started = startableThreads(count);
#pragma omp parallel num_threads(started)
    {
    }
  }
  else
  {
    started = count;
  }
  return started;
}

void Context::checkpoint() const
{
  if (stopRequested())
  {
    throw Cancelled("stopped by the user");
  }
}

} // namespace cactus
