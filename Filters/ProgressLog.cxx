// SPDX-License-Identifier: BSD-3-Clause
#include "ProgressLog.h"

#include "Ranks.h"
#include "base/Error.h"
#include "base/Pace.h"
#include "base/WholeNumber.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace cactus
{

namespace
{

std::chrono::seconds pauseAsked()
{
  constexpr const char* variable = "CACTUS_PROGRESS";
  const char* asked = std::getenv(variable);
  const bool isAsked = asked != nullptr && *asked != '\0';
  return std::chrono::seconds(
    isAsked ? wholeNumber(text("the environment variable ", variable), asked, progressPauses) : usualProgressPause);
}

} // namespace

ProgressLog::ProgressLog(std::string who)
  : Who(std::move(who))
  , Pause(isFirstProcess() ? pauseAsked() : std::chrono::seconds(0))
  , LastTime(std::chrono::steady_clock::now())
{
}

void ProgressLog::tell(double fraction, const std::string& message)
{
  const auto now = std::chrono::steady_clock::now();
  if (this->Pause.count() > 0 && now - this->LastTime >= this->Pause)
  {
    this->LastTime = now;
    std::fprintf(stderr, "%s: %s\n", this->Who.c_str(), progressLine(fraction, message).c_str());
  }
}

} // namespace cactus
