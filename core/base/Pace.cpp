// SPDX-License-Identifier: BSD-3-Clause
#include "base/Pace.h"

#include "base/Numbers.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

constexpr double leastSeconds = 10.0;
constexpr double leastFraction = 1e-3;
constexpr double leastOfAll = 0.04; // what comes before are short parts, of which one fraction takes much longer than another
constexpr double window = 600.0;
constexpr double mostPercent = 99.5; // largest with two digits

std::string duration(double seconds)
{
  const double minutes = std::max(1.0, std::round(seconds / 60.0));
  const double hours = std::floor(minutes / 60.0);
  TextStream words;
  if (hours > 0.0)
  {
    words << hours << " h ";
  }
  words << minutes - 60.0 * hours << " min";
  return words.str();
}

} // namespace

std::string Pace::at(double seconds, double fraction, const std::string& part)
{
  const Moment now{ seconds, fraction };
  if (!this->First || part != this->Part)
  {
    this->Part = part;
    this->First = this->Next = now;
  }
  if (seconds - this->Next.seconds > window)
  {
    this->First = this->Next;
    this->Next = now;
  }
  const double spent = seconds - this->First->seconds;
  const double done = fraction - this->First->fraction;
  if (spent < leastSeconds || done < leastFraction || fraction < leastOfAll)
  {
    return {};
  }
  TextStream words;
  words.precision(2);
  const double anHour = 100.0 * done / spent * 3600.0;
  if (anHour < mostPercent)
  {
    words << anHour << " % an hour, ";
  }
  else if (anHour < 60.0 * mostPercent)
  {
    words << anHour / 60.0 << " % a minute, ";
  }
  words << "ready in about ";
  return words.str() + duration((1.0 - fraction) * spent / done);
}

std::string progressLine(double fraction, const std::string& message)
{
  const std::string percent = std::to_string(static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0)));
  return std::string(percent.size() < 3 ? 3 - percent.size() : 0, ' ') + percent + " %  " + onOneLine(message);
}

} // namespace cactus
