// SPDX-License-Identifier: BSD-3-Clause
#include "BackgroundOptimisation.h"

#include "base/Context.h"

#include <utility>

namespace cactus
{

BackgroundOptimisation::BackgroundOptimisation(Fibres fibres, const CapsuleOptimizerOptions& options, int threads, int interval)
  : Moving(std::move(fibres))
  , Worker([this, options, threads, interval] { this->run(options, threads, interval); })
{
}

BackgroundOptimisation::~BackgroundOptimisation()
{
  this->stop();
  this->Worker.join();
}

void BackgroundOptimisation::stop()
{
  this->WantsStop = true;
}

void BackgroundOptimisation::run(const CapsuleOptimizerOptions& options, int threads, int interval)
{
  // Without progress: the caller's must not be called from another thread.
  Context context;
  context.threads = threads;
  context.cancelled = [this] { return this->WantsStop.load(); };
  OptimisationResult result;
  std::exception_ptr failure;
  try
  {
    result = optimise(this->Moving, options, context,
      [&](const ConvergenceRow& row, const Fibres& fibres) { this->show(row, fibres, interval); });
  }
  catch (...)
  {
    failure = std::current_exception();
  }
  const std::lock_guard<std::mutex> lock(this->Guard);
  this->Result = std::move(result);
  this->Failure = failure;
  this->IsOver = true;
  this->Changed.notify_all();
}

void BackgroundOptimisation::show(const ConvergenceRow& row, const Fibres& fibres, int interval)
{
  this->Rows.push_back(row);
  if (row.iteration % interval != 0 && this->IsFirstThere) // only this thread sets it; a run may continue from any iteration
  {
    return;
  }
  State state{ fibres, this->Rows };
  const std::lock_guard<std::mutex> lock(this->Guard);
  this->Newest = std::move(state);
  this->IsNew = true;
  this->IsFirstThere = true;
  this->Changed.notify_all();
}

bool BackgroundOptimisation::hasNews() const
{
  const std::lock_guard<std::mutex> lock(this->Guard);
  return this->IsOver ? !this->IsTaken : this->IsNew;
}

bool BackgroundOptimisation::isOver() const
{
  std::unique_lock<std::mutex> lock(this->Guard);
  this->Changed.wait(lock, [this] { return this->IsFirstThere || this->IsOver; });
  return this->IsOver;
}

BackgroundOptimisation::State BackgroundOptimisation::take()
{
  const std::lock_guard<std::mutex> lock(this->Guard);
  this->IsNew = false;
  return this->Newest;
}

OptimisationResult BackgroundOptimisation::result(Fibres& fibres)
{
  const std::lock_guard<std::mutex> lock(this->Guard);
  this->IsTaken = true;
  if (this->Failure)
  {
    std::rethrow_exception(this->Failure);
  }
  fibres = std::move(this->Moving);
  return std::move(this->Result);
}

} // namespace cactus
