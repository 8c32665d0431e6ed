// SPDX-License-Identifier: BSD-3-Clause
#include "base/WholeNumber.h"

#include "base/Error.h"
#include "base/Numbers.h"

#include <cmath>
#include <string_view>

namespace cactus
{

int wholeNumber(const std::string& name, const std::string& given, const Range& range)
{
  std::string_view rest = given;
  double number = 0.0;
  if (!takeNumber(rest, number) || !rest.empty() || number != std::floor(number) || !range.holds(number))
  {
    throw InvalidInput(
      text(name, " is ", excerpt(given), ": give a whole number from ", int(range.lowest), " to ", int(range.highest)));
  }
  return static_cast<int>(number);
}

} // namespace cactus
