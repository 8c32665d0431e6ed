// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "optimiser/CapsuleOptimizer.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace cactus
{

/// An optimisation in a thread of its own, with the bits of one that its caller waits for, which can be looked at meanwhile.
class BackgroundOptimisation
{
public:
  /// A state on the way.
  struct State
  {
    Fibres fibres;
    std::vector<ConvergenceRow> rows; ///< up to the one of this state
  };

  /// Starts. The first state and those of every `interval`-th iteration are shown.
  BackgroundOptimisation(Fibres fibres, const CapsuleOptimizerOptions& options, int threads, int interval);
  BackgroundOptimisation(const BackgroundOptimisation&) = delete;
  BackgroundOptimisation& operator=(const BackgroundOptimisation&) = delete;
  /// Stops, and loses the result.
  ~BackgroundOptimisation();

  /// Ends it soon, with its best state as the result.
  void stop();

  /// Whether there is a state that nobody has taken, or the result.
  bool hasNews() const;

  /// Waits for the first state, and tells whether the run has come to its end.
  bool isOver() const;

  /// The newest state.
  State take();

  /// The result of a run that is over, once; throws what it threw.
  OptimisationResult result(Fibres& fibres);

private:
  void run(const CapsuleOptimizerOptions& options, int threads, int interval);
  void show(const ConvergenceRow& row, const Fibres& fibres, int interval);

  Fibres Moving; ///< the worker's
  std::vector<ConvergenceRow> Rows;
  std::atomic<bool> WantsStop{ false };

  mutable std::mutex Guard; ///< of all that follows
  mutable std::condition_variable Changed;
  State Newest;
  bool IsNew = false;
  bool IsFirstThere = false;
  bool IsOver = false;
  bool IsTaken = false; ///< the result
  OptimisationResult Result;
  std::exception_ptr Failure;

  std::thread Worker; ///< last: it starts with all of the above
};

} // namespace cactus
