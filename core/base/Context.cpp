// SPDX-License-Identifier: BSD-3-Clause
#include "base/Context.h"

#include "base/Error.h"
#include "base/Memory.h"
#include "base/Threads.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

namespace cactus
{

int Context::threadCount() const
{
  constexpr int always = 16;
  const int asked = threads > 0 ? threads : usualThreadCount();
  int count = std::min(asked, std::max(processorCount(), always));
  if (isAtSharedWork())
  {
    return count;
  }
  if (count > startedThreads())
  {
    // Each thread needs a stack and an arena of malloc; if address space is limited, half of it is left for the work.
    constexpr double each = 80e6;
    count = static_cast<int>(std::clamp(0.5 * static_cast<double>(availableAddressSpace()) / each, 1.0, double(count)));
  }
  // Starts them at once, since later there may be less room.
  return startThreads(count);
}

Context Context::part(double from, double to) const
{
  Context part = *this;
  if (progress)
  {
    part.progress = [whole = progress, from, to](double fraction, const std::string& message)
    { whole(from + (to - from) * fraction, message); };
  }
  return part;
}

Context Context::forThreads() const
{
  Context shared = *this;
  shared.cancelled = [this, own = std::this_thread::get_id(), isStopped = std::make_shared<std::atomic<bool>>(false)]
  {
    if (std::this_thread::get_id() == own && stopRequested())
    {
      *isStopped = true;
    }
    return isStopped->load();
  };
  return shared;
}

void Context::checkpoint() const
{
  if (stopRequested())
  {
    throw Cancelled();
  }
}

} // namespace cactus
