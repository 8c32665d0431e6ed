// SPDX-License-Identifier: BSD-3-Clause
// Threads that loops are shared among (see Parallel.h). Those that wait give way to other programs soon, and a loop does not wait
// for a thread that has not come to it. With OpenMP's it did, for seconds where others held the cores.
#pragma once

#include <functional>

namespace cactus
{

/// How many processors this process may run on.
int processorCount();

/// The number of threads to use by default: the first number of the environment variable OMP_NUM_THREADS, else one for each
/// processor. Throws InvalidInput where that variable holds something else.
int usualThreadCount();

/// How many threads work of the calling thread can be shared among so far, that one included.
int startedThreads();

/// Starts threads until there are `wanted`, and returns their number: fewer where the system starts no more.
int startThreads(int wanted);

/// Whether the calling thread is at work that is shared: what it shares out from there it does alone.
bool isAtSharedWork();

/// Runs work(thread) in the calling thread, as thread 0, and at the same time in others, thread < threads. It returns when all of
/// these are done. Others that come too late do not take part, so what there is to do must not depend on their number. `work`
/// must not throw. A child of fork() has threads of its own.
void shareWork(int threads, const std::function<void(int)>& work);

} // namespace cactus
