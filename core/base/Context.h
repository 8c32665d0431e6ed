// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace cactus
{

/// What a long operation needs of its caller: threads, a place to report to, and whether to stop.
///
/// `progress` and `cancelled` are only ever called from the thread that called the operation.
struct Context
{
  /// To use at most; 0 means as many as the environment variable OMP_NUM_THREADS says, else all that the machine offers.
  int threads = 0;
  /// Called with a fraction in [0, 1] and a short sentence.
  std::function<void(double, const std::string&)> progress;
  /// True once the caller wants the operation to stop.
  std::function<bool()> cancelled;

  /// `threads`, with 0 replaced by that: at most the larger of 16 and the machine's processors, and no more than
  /// the system lets this process start (limits on address space and on the number of threads). At least 1. No result depends
  /// on it. Throws InvalidInput where that variable holds no number.
  int threadCount() const;
  void report(double fraction, const std::string& message) const
  {
    if (progress)
    {
      progress(fraction, message);
    }
  }
  /// The same for a part of the work, from one fraction of the whole to another.
  Context part(double from, double to) const;
  bool stopRequested() const { return cancelled && cancelled(); }
  /// Throws Cancelled once the caller wants the operation to stop.
  void checkpoint() const;
};

} // namespace cactus
