// SPDX-License-Identifier: BSD-3-Clause
#include "StopSignals.h"

#include "RankTeam.h"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <mutex>
#include <string>

namespace cactus
{

namespace
{

constexpr std::array<int, 2> watched{ { SIGINT, SIGTERM } };

std::atomic<int> caught{ 0 }; ///< the signal, or 0
static_assert(std::atomic<int>::is_always_lock_free);
std::array<struct sigaction, watched.size()> usual; ///< what is done with each while none lives
std::atomic<bool> isSpeaker{ true };                ///< read where a signal is caught
static_assert(std::atomic<bool>::is_always_lock_free);
std::mutex guard;
int living = 0;

extern "C" void noteStopSignal(int number)
{
  static constexpr char acknowledgement[] = "\nCACTUS: stopping in good order; a second signal ends it at once\n";
  caught = number;
  struct sigaction action = {};
  action.sa_handler = SIG_DFL;
  for (const int each : watched)
  {
    ::sigaction(each, &action, nullptr);
  }
  if (isSpeaker)
  {
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, acknowledgement, sizeof(acknowledgement) - 1);
  }
}

bool isIgnored(const struct sigaction& action)
{
  return (action.sa_flags & SA_SIGINFO) == 0 && action.sa_handler == SIG_IGN;
}

/// Tells whether a signal goes to the log, which would print a stack trace and end the program.
bool isForLog(const struct sigaction& action)
{
  // Both members share their memory.
  const bool isDefault = action.sa_handler == SIG_DFL || action.sa_handler == SIG_IGN;
  Dl_info library{};
  return !isDefault && ::dladdr(reinterpret_cast<void*>(action.sa_handler), &library) != 0 && library.dli_fname != nullptr &&
         std::string(library.dli_fname).find("loguru") != std::string::npos;
}

} // namespace

StopSignals::StopSignals()
{
  const std::lock_guard<std::mutex> lock(guard);
  if (living++ > 0)
  {
    return;
  }
  isSpeaker = RankTeam().place() == 0;
  struct sigaction action = {};
  action.sa_handler = noteStopSignal;
  for (std::size_t i = 0; i < watched.size(); ++i)
  {
    ::sigaction(watched[i], nullptr, &usual[i]);
    if (isForLog(usual[i]))
    {
      usual[i] = {};
      usual[i].sa_handler = SIG_DFL;
    }
  }
  for (std::size_t i = 0; i < watched.size(); ++i)
  {
    if (!isIgnored(usual[i])) // as with nohup
    {
      ::sigaction(watched[i], &action, nullptr);
    }
  }
}

StopSignals::~StopSignals()
{
  const std::lock_guard<std::mutex> lock(guard);
  if (--living > 0)
  {
    return;
  }
  for (std::size_t i = 0; i < watched.size(); ++i)
  {
    ::sigaction(watched[i], &usual[i], nullptr);
  }
  if (const int number = caught.exchange(0); number != 0)
  {
    ::raise(number);
  }
}

bool StopSignals::areCaught()
{
  return caught != 0;
}

} // namespace cactus
