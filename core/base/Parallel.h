// SPDX-License-Identifier: BSD-3-Clause
// Loops shared among threads. There are no others in this library: what a body throws, and a caller who wants to stop, are
// dealt with here.
#pragma once

#include "base/Context.h"
#include "base/Error.h"
#include "base/Threads.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>

namespace cactus
{

/// Ends a parallel loop before its time, and carries out of it what ended it: an exception must not leave the thread that it came
/// up in.
class LoopEnd
{
public:
  /// Runs `work` and keeps what it throws: of several exceptions that of the smallest index.
  template <typename Work>
  void run(std::size_t index, Work&& work) noexcept
  {
    try
    {
      work();
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      if (!this->Failure || index < this->FailedIndex)
      {
        this->FailedIndex = index;
        this->Failure = std::current_exception();
      }
      this->Reached = true;
    }
  }

  void stop() { this->Stopped = this->Reached = true; }

  /// Whether what is left of the loop need not be done.
  bool reached() const { return this->Reached; }

  /// Throws, after the loop, what was thrown inside, or Cancelled after stop().
  void rethrow() const
  {
    if (this->Failure)
    {
      std::rethrow_exception(this->Failure);
    }
    if (this->Stopped)
    {
      throw Cancelled();
    }
  }

private:
  std::mutex Mutex;
  std::exception_ptr Failure;
  std::size_t FailedIndex = 0;
  std::atomic<bool> Stopped{ false };
  std::atomic<bool> Reached{ false };
};

/// The loop that the others are made of: body(worker, i) for i in [0, count), dynamically shared among `threads` threads, each
/// with a worker of its own, made by makeWorker(thread). The calling thread asks wantsMore() after each of its bodies.
template <typename MakeWorker, typename Body, typename WantsMore>
void runLoop(std::size_t count, int threads, MakeWorker&& makeWorker, Body&& body, WantsMore&& wantsMore)
{
  LoopEnd end;
  std::atomic<std::size_t> next{ 0 };
  const auto take = [&](int thread)
  {
    std::optional<std::decay_t<decltype(makeWorker(0))>> worker;
    end.run(count, [&] { worker.emplace(makeWorker(thread)); });
    for (std::size_t i = 0; !end.reached() && (i = next++) < count;)
    {
      end.run(i,
        [&]
        {
          body(*worker, i);
          if (thread == 0 && !wantsMore())
          {
            end.stop();
          }
        });
    }
  };
  if (count > 0)
  {
    shareWork(static_cast<int>(std::min(count, static_cast<std::size_t>(threads))), take);
  }
  end.rethrow();
}

/// For long work: runs body(worker, i) for i in [0, count), dynamically shared among the context's threads. Each thread has a
/// worker of its own, which makeWorker(thread), thread < context.threadCount(), makes there. What is thrown ends the loop and is
/// rethrown in the caller's thread, the one of the smallest index that threw; throws Cancelled where the caller wants to stop,
/// before, during or right after the loop. Progress runs from `from` to `to`, reported in steps of a hundredth of that.
template <typename MakeWorker, typename Body>
void parallelForWithWorkers(std::size_t count, const Context& context, MakeWorker&& makeWorker, Body&& body,
  const std::string& message = "", double from = 0.0, double to = 1.0)
{
  context.checkpoint();
  std::atomic<std::size_t> done{ 0 };
  double reported = 0.0;
  runLoop(
    count, context.threadCount(), makeWorker,
    [&](auto& worker, std::size_t i)
    {
      body(worker, i);
      ++done;
    },
    [&]
    {
      const double fraction = static_cast<double>(done) / static_cast<double>(count);
      if (!message.empty() && (fraction >= reported + 0.01 || done == count))
      {
        reported = fraction;
        context.report(from + (to - from) * fraction, message);
      }
      return !context.stopRequested();
    });
  // The other threads may have done the whole of it before the caller's thread came to ask.
  context.checkpoint();
}

/// The same without workers: runs body(i), for bodies that write to slots of their own.
template <typename Body>
void parallelFor(
  std::size_t count, const Context& context, Body&& body, const std::string& message = "", double from = 0.0, double to = 1.0)
{
  parallelForWithWorkers(
    count, context, [](int) { return 0; }, [&](int, std::size_t i) { body(i); }, message, from, to);
}

/// For short work that nobody wants to stop: runs body(block, begin, end) for [0, count) cut into blocks of blockSize, the last
/// one shorter, dynamically shared among `threads` threads. Sums that are kept per block and added up in the order of the blocks
/// do not depend on the threads. Rethrows what the smallest block threw.
template <typename Body>
void parallelBlocks(std::size_t count, std::size_t blockSize, int threads, Body&& body)
{
  const std::size_t blocks = (count + blockSize - 1) / blockSize;
  runLoop(
    blocks, threads, [](int) { return 0; },
    [&](int, std::size_t block)
    {
      const std::size_t begin = block * blockSize;
      body(block, begin, std::min(count, begin + blockSize));
    },
    [] { return true; });
}

/// The same, with body(i) for each i: for loops over capsules or control points, of which one alone is too little to share out.
template <typename Body>
void parallelForInBlocks(std::size_t count, std::size_t blockSize, int threads, Body&& body)
{
  parallelBlocks(count, blockSize, threads,
    [&](std::size_t, std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        body(i);
      }
    });
}

} // namespace cactus
