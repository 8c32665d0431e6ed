// SPDX-License-Identifier: BSD-3-Clause
// What every filter needs around a call into core: errors turned into VTK's, progress and stopping passed on.
#pragma once

#include "Context.h"
#include "Error.h"

#include <vtkAlgorithm.h>
#include <vtkSetGet.h>

#include <cstdint>
#include <memory>
#include <new>
#include <string>

namespace cactus
{

/// Context whose progress goes to `algorithm` and which stops when the user aborts it. Throws InvalidInput for a negative number
/// of threads.
inline Context contextFor(vtkAlgorithm* algorithm, int threads = 0)
{
  if (threads < 0)
  {
    throw InvalidInput("NumberOfThreads is " + std::to_string(threads) + ": give 0 for all, or how many");
  }
  Context context;
  context.threads = threads;
  context.progress = [algorithm](double fraction, const std::string& message)
  {
    algorithm->SetProgressText(message.c_str());
    algorithm->UpdateProgress(fraction);
  };
  // The flag is taken back here and once it is noticed. VTK leaves it set, which would stop the next run at its start; and
  // cleared by others after this run, it would mark the filter as modified and have it run again.
  algorithm->SetAbortExecute(0);
  // Not CheckAbort(): once that has returned true, VTK empties every output, also a best result worth keeping.
  context.cancelled = [algorithm, stopped = std::make_shared<bool>(false)]
  {
    if (algorithm->GetAbortExecute() != 0)
    {
      *stopped = true;
      algorithm->SetAbortExecute(0);
    }
    return *stopped;
  };
  return context;
}

/// A user's seed as core takes it. Throws InvalidInput for a negative one.
inline std::uint64_t seedFrom(int seed)
{
  if (seed < 0)
  {
    throw InvalidInput("Seed is " + std::to_string(seed) + ": give a number that is not negative");
  }
  return static_cast<std::uint64_t>(seed);
}

/// Runs `work` and returns 1, or reports what it threw as the algorithm's error and returns 0.
template <typename Algorithm, typename Work>
int guarded(Algorithm* self, Work&& work)
{
  try
  {
    work();
    return 1;
  }
  catch (const Error& error)
  {
    vtkErrorWithObjectMacro(self, << error.what());
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorWithObjectMacro(self, << "out of memory: choose a smaller Side or a larger VoxelSize");
  }
  return 0;
}

} // namespace cactus
