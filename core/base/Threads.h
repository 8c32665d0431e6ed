// SPDX-License-Identifier: BSD-3-Clause
// The project's only use of OpenMP. Loops are written with Parallel.h.
#pragma once

#include <functional>

namespace cactus
{

/// The number of processors that this process may run on.
int processorCount();

/// The number of threads to use by default: the first number of the environment variable OMP_NUM_THREADS, else one for each
/// processor. Throws InvalidInput where that variable holds something else.
int usualThreadCount();

/// The number of threads, the calling one included, that shareWork() has started so far for the calling thread.
int startedThreads();

/// Starts threads until there are `wanted`, and returns their number: fewer where the system starts no more.
int startThreads(int wanted);

/// Whether the calling thread is inside shareWork(). A loop in there runs in this thread alone.
bool isAtSharedWork();

/// Runs work(thread) in `threads` threads at most, the calling one as thread 0, and returns when all are done. What there is to
/// do must not depend on their number. `work` must not throw.
void shareWork(int threads, const std::function<void(int)>& work);

} // namespace cactus
