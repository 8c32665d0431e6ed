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

/// An optimisation in its own thread, whose states can be read meanwhile. It gives the same bits as one in the caller's thread.
class BackgroundOptimisation
{
public:
  /// An intermediate state.
  struct State
  {
    Fibres fibres;
    std::vector<ConvergenceRow> rows; ///< up to that of this state
  };

  /// Starts. The first state and those of every `interval`-th iteration are shown.
  BackgroundOptimisation(Fibres fibres, const CapsuleOptimizerOptions& options, int threads, int interval);
  BackgroundOptimisation(const BackgroundOptimisation&) = delete;
  BackgroundOptimisation& operator=(const BackgroundOptimisation&) = delete;
  /// Stops, and discards the result.
  ~BackgroundOptimisation();

  /// Ends it soon, with its best state as the result.
  void stop();

  /// Tells whether there is a new state, or the result.
  bool hasNews() const;

  /// Waits for the first state, and tells whether the run has ended.
  bool isOver() const;

  /// Returns the newest state.
  State take();

  /// Returns the result of a run that has ended, once; throws the run's exception.
  OptimisationResult result(Fibres& fibres);

private:
  void run(const CapsuleOptimizerOptions& options, int threads, int interval);
  void show(const ConvergenceRow& row, const Fibres& fibres, int interval);

  Fibres Moving; ///< used by the worker
  std::vector<ConvergenceRow> Rows;
  std::atomic<bool> WantsStop{ false };

  mutable std::mutex Guard; ///< of all members below
  mutable std::condition_variable Changed;
  State Newest;
  bool IsNew = false;
  bool IsFirstThere = false;
  bool IsOver = false;
  bool IsTaken = false; ///< whether the result was taken
  OptimisationResult Result;
  std::exception_ptr Failure;

  std::thread Worker; ///< last, since it starts with all members above
};

} // namespace cactus
