// SPDX-License-Identifier: BSD-3-Clause
// Names of many files of a kind.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

namespace cactus
{

/// At most so many are in one folder.
constexpr std::size_t filesInAFolder = 1000;

/// A number in five digits, or as many as it takes.
inline std::string fiveDigits(std::size_t number)
{
  const std::string digits = std::to_string(number);
  return std::string(5 - std::min<std::size_t>(5, digits.size()), '0') + digits;
}

} // namespace cactus
