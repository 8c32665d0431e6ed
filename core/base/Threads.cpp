// SPDX-License-Identifier: BSD-3-Clause
#include "base/Threads.h"

#include "base/Error.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace cactus
{

namespace
{

/// How long a thread holds its core while it waits: loops of the optimiser follow each other in less, and other programs do not
/// miss it.
constexpr std::chrono::microseconds shortWait(100);

thread_local bool atSharedWork = false;

/// Tells the core that this thread has nothing to do but look again.
inline void pauseCore()
{
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

/// Whether something has come to be within a short time.
template <typename Condition>
bool comesSoon(Condition&& condition)
{
  constexpr int looksAtOnce = 8;
  const auto end = std::chrono::steady_clock::now() + shortWait;
  do
  {
    for (int look = 0; look < looksAtOnce; ++look)
    {
      if (condition())
      {
        return true;
      }
      pauseCore();
    }
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

/// The threads that help one thread. Work is given out in rounds: while one is open, helpers enter it when they come to see it;
/// it ends when it is closed and all that entered have left.
class Helpers
{
public:
  Helpers() = default;
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;
  ~Helpers()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Ending = true;
    }
    this->Opened.notify_all();
    for (std::thread& thread : this->Threads)
    {
      thread.join();
    }
  }

  int count() const { return static_cast<int>(this->Threads.size()); }
  bool isOfThisProcess() const { return this->Process == getpid(); }

  /// Starts more, as far as the system lets it.
  void growTo(int count)
  {
    try
    {
      while (this->count() < count)
      {
        this->Threads.emplace_back(&Helpers::serve, this, this->count() + 1, roundOf(this->State));
      }
    }
    catch (const std::exception&)
    {
      // No room for another stack, or a limit on the number of threads.
    }
  }

  /// threads: the calling one included.
  void share(int threads, const std::function<void(int)>& work)
  {
    this->Work = &work;
    this->Places = threads;
    this->Spins = this->count() < processorCount();
    this->State = (roundOf(this->State) + 1) << roundShift;
    if (this->Sleeping > 0)
    {
      {
        const std::lock_guard<std::mutex> lock(this->Mutex);
      }
      this->Opened.notify_all();
    }
    work(0);
    this->State |= closed;
    const auto isDone = [this] { return isEmpty(this->State); };
    if (!(this->Spins ? comesSoon(isDone) : isDone()))
    {
      std::unique_lock<std::mutex> lock(this->Mutex);
      this->Emptied.wait(lock, isDone);
    }
  }

private:
  // State holds the number of the round, whether it is closed, and how many helpers are in it.
  static constexpr int roundShift = 32;
  static constexpr std::uint64_t closed = std::uint64_t(1) << 31;

  static std::uint64_t roundOf(std::uint64_t state) { return state >> roundShift; }
  static bool isOpen(std::uint64_t state) { return (state & closed) == 0; }
  static bool isEmpty(std::uint64_t state) { return (state & (closed - 1)) == 0; }

  void serve(int thread, std::uint64_t round)
  {
    atSharedWork = true;
    while (this->waitForRoundAfter(round))
    {
      if (!this->enter(round))
      {
        continue;
      }
      if (thread < this->Places)
      {
        (*this->Work)(thread);
      }
      const std::uint64_t left = --this->State;
      if (!isOpen(left) && isEmpty(left))
      {
        {
          const std::lock_guard<std::mutex> lock(this->Mutex);
        }
        this->Emptied.notify_one();
      }
    }
  }

  /// False once there will be none.
  bool waitForRoundAfter(std::uint64_t round)
  {
    const auto isThere = [&]
    {
      const std::uint64_t state = this->State;
      return (isOpen(state) && roundOf(state) != round) || this->Ending;
    };
    if (!(this->Spins ? comesSoon(isThere) : isThere()))
    {
      std::unique_lock<std::mutex> lock(this->Mutex);
      ++this->Sleeping;
      this->Opened.wait(lock, isThere);
      --this->Sleeping;
    }
    return !this->Ending;
  }

  /// Leaves in `round` which one it is.
  bool enter(std::uint64_t& round)
  {
    std::uint64_t state = this->State;
    while (isOpen(state) && roundOf(state) != round)
    {
      if (this->State.compare_exchange_weak(state, state + 1))
      {
        round = roundOf(state);
        return true;
      }
    }
    return false;
  }

  const pid_t Process = getpid();
  std::vector<std::thread> Threads;
  std::atomic<std::uint64_t> State{ closed };
  std::atomic<bool> Spins{ true }; ///< false where there are more threads than processors
  std::atomic<bool> Ending{ false };
  std::mutex Mutex;
  std::condition_variable Opened;
  std::condition_variable Emptied;
  std::atomic<int> Sleeping{ 0 };
  // Of the round, written before it is opened.
  const std::function<void(int)>* Work = nullptr;
  int Places = 0;
};

/// A thread's own.
class OwnHelpers
{
public:
  OwnHelpers() = default;
  OwnHelpers(const OwnHelpers&) = delete;
  OwnHelpers& operator=(const OwnHelpers&) = delete;
  ~OwnHelpers()
  {
    if (this->Held != nullptr && this->Held->isOfThisProcess())
    {
      delete this->Held;
    }
  }

  Helpers& get()
  {
    // Those of the process that this one was forked from do not come along, and what they hold stays as it was.
    if (this->Held == nullptr || !this->Held->isOfThisProcess())
    {
      this->Held = new Helpers;
    }
    return *this->Held;
  }

private:
  Helpers* Held = nullptr;
};

Helpers& helpers()
{
  thread_local OwnHelpers own;
  return own.get();
}

} // namespace

int processorCount()
{
  static const int count = []
  {
    cpu_set_t mine;
    const int known = sched_getaffinity(0, sizeof(mine), &mine) == 0 ? CPU_COUNT(&mine) : 0;
    return known > 0 ? known : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }();
  return count;
}

int usualThreadCount()
{
  const char* value = std::getenv("OMP_NUM_THREADS");
  if (value == nullptr || *value == '\0')
  {
    return processorCount();
  }
  char* end = nullptr;
  const long count = std::strtol(value, &end, 10);
  if (end == value || (*end != '\0' && *end != ',') || count < 1)
  {
    throw InvalidInput(text(
      "the environment variable OMP_NUM_THREADS is '", value, "': set it to a number of threads from 1 upwards, or unset it"));
  }
  return static_cast<int>(std::min<long>(count, 1 << 20));
}

int startedThreads()
{
  return helpers().count() + 1;
}

int startThreads(int wanted)
{
  helpers().growTo(wanted - 1);
  return std::min(wanted, startedThreads());
}

bool isAtSharedWork()
{
  return atSharedWork;
}

void shareWork(int threads, const std::function<void(int)>& work)
{
  if (atSharedWork || startThreads(threads) < 2)
  {
    work(0);
    return;
  }
  atSharedWork = true;
  helpers().share(threads, work);
  atSharedWork = false;
}

} // namespace cactus
