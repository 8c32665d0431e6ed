// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace cactus
{

/// What a long operation gets from its caller: threads, a progress callback, and a stop request.
///
/// `progress` and `cancelled` are only ever called from the thread that called the operation.
struct Context
{
  /// At most this many; 0 means the value of the environment variable OMP_NUM_THREADS, else all processors.
  int threads = 0;
  /// Called with a fraction in [0, 1] and a short sentence.
  std::function<void(double, const std::string&)> progress;
  /// True once the caller wants the operation to stop.
  std::function<bool()> cancelled;

  /// Returns the number of threads to use, at least 1: at most the larger of 16 and the machine's processors, and no more than
  /// the system lets this process start (limits on address space and on threads). No result depends on it. Throws InvalidInput if
  /// OMP_NUM_THREADS holds no number.
  int threadCount() const;
  void report(double fraction, const std::string& message) const
  {
    if (progress)
    {
      progress(fraction, message);
    }
  }
  /// Returns a context for a part of the work, from one fraction of the whole to another.
  Context part(double from, double to) const;
  bool stopRequested() const { return cancelled && cancelled(); }
  /// Throws Cancelled once the caller wants the operation to stop.
  void checkpoint() const;
  /// Returns a context that several threads may ask whether to stop: only the thread that calls this one asks the caller. This
  /// object must outlive it.
  Context forThreads() const;
};

} // namespace cactus
