// SPDX-License-Identifier: BSD-3-Clause
#include "ProgressLog.h"

#include "Ranks.h"
#include "base/Error.h"
#include "base/Pace.h"

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <utility>

namespace cactus
{

namespace
{

constexpr int usualPause = 60; // s

std::chrono::seconds pauseAsked()
{
  const char* asked = std::getenv("CACTUS_PROGRESS");
  if (asked == nullptr || *asked == '\0')
  {
    return std::chrono::seconds(usualPause);
  }
  char* end = nullptr;
  const long seconds = std::strtol(asked, &end, 10);
  if (end == asked || *end != '\0' || seconds < 0 || seconds > std::numeric_limits<int>::max())
  {
    throw InvalidInput(text("the environment variable CACTUS_PROGRESS is '", asked,
      "': set it to the seconds between two lines of progress, a whole number (0: none), or unset it"));
  }
  return std::chrono::seconds(seconds);
}

} // namespace

ProgressLog::ProgressLog(std::string who)
  : Who(std::move(who))
  , Pause(pauseAsked())
  , LastTime(std::chrono::steady_clock::now())
{
}

void ProgressLog::tell(double fraction, const std::string& message)
{
  const auto now = std::chrono::steady_clock::now();
  if (this->Pause.count() > 0 && now - this->LastTime >= this->Pause && isFirstProcess())
  {
    this->LastTime = now;
    std::fprintf(stderr, "%s: %s\n", this->Who.c_str(), progressLine(fraction, message).c_str());
  }
}

} // namespace cactus
