// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Limits.h"

#include <string>

namespace cactus
{

/// Seconds between two lines of progress in the log of a job; 0: there are none.
constexpr Range progressPauses{ 0.0, 86400.0 }; // a day
constexpr int usualProgressPause = 60;

/// The whole number that somebody has given as `name`, an option or an environment variable. Throws InvalidInput, with the name,
/// for anything else, and beyond `range`.
int wholeNumber(const std::string& name, const std::string& given, const Range& range);

} // namespace cactus
