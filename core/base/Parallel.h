// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Error.h"

#include <atomic>
#include <cstddef>
#include <exception>
#include <string>

namespace cactus
{

/// Carries what is thrown inside of a parallel region out of it, since an exception must not leave the region by itself: of
/// several the one that came first.
///
///     Carrier carrier;
///     #pragma omp parallel
///     {
///       carrier.run([&] { … });
///     }
///     carrier.rethrow();
class Carrier
{
public:
  /// Runs `work` and keeps what it throws.
  template <typename Work>
  void run(Work&& work) noexcept
  {
    try
    {
      work();
    }
    catch (...)
    {
#pragma omp critical(cactusCarrier)
      {
        if (!this->Failure)
        {
          this->Failure = std::current_exception();
        }
      }
      this->Failed = true;
    }
  }

  /// Whether anything has been thrown so far: then there is no use in going on.
  bool failed() const
  {
    return this->Failed;
  }

  /// Throws it again, after the region.
  void rethrow() const
  {
    if (this->Failure)
    {
      std::rethrow_exception(this->Failure);
    }
  }

private:
  std::exception_ptr Failure;
  std::atomic<bool> Failed{ false };
};

/// Runs body(i) for i in [0, count), dynamically shared among the context's threads, for bodies that write to slots of their own.
/// What a body throws ends the loop and is rethrown in the caller's thread, the one of the smallest index that threw; throws
/// Cancelled where the caller wants to stop, before, during or right after the loop. Progress runs from `from` to `to`.
template <typename Body>
void parallelFor(
  std::size_t count, const Context& context, Body&& body, const std::string& message = "", double from = 0.0, double to = 1.0)
{
  context.checkpoint();
  std::exception_ptr failure;
  std::size_t failedIndex = count;
  std::atomic<bool> stop{ false };
  std::atomic<std::size_t> done{ 0 };
  const auto total = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel num_threads(context.threadCount())
  {
    // Only the thread that called may report and ask; the one that runs this function outside the region is its thread 0.
    bool isCaller = false;
#pragma omp master
    isCaller = true;
#pragma omp for schedule(dynamic)
    for (std::ptrdiff_t i = 0; i < total; ++i)
    {
      if (stop)
      {
        continue;
      }
      try
      {
        body(static_cast<std::size_t>(i));
        const std::size_t finished = ++done;
        if (isCaller && !message.empty())
        {
          context.report(from + (to - from) * static_cast<double>(finished) / static_cast<double>(count), message);
        }
        if (isCaller && context.stopRequested())
        {
          stop = true;
        }
      }
      catch (...)
      {
#pragma omp critical(cactusParallelFor)
        {
          if (static_cast<std::size_t>(i) < failedIndex)
          {
            failedIndex = static_cast<std::size_t>(i);
            failure = std::current_exception();
          }
        }
        stop = true;
      }
    }
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  // The other threads may have done the whole of it before the caller's thread came to ask.
  if (stop)
  {
    throw Cancelled("stopped by the user");
  }
  context.checkpoint();
}

} // namespace cactus
