// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Limits.h"

#include <string>

namespace cactus
{

/// Seconds between two lines of progress in a job's log; 0 for no lines.
constexpr Range progressPauses{ 0.0, 86400.0 }; // a day
constexpr int usualProgressPause = 60;

/// Returns the whole number given as `name`, an option or an environment variable. Throws InvalidInput, with the name, for
/// anything else and for a number out of `range`.
int wholeNumber(const std::string& name, const std::string& given, const Range& range);

} // namespace cactus
