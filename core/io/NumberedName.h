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

/// A number with as many digits as the largest of its kind has, at least five: names then sort as their numbers do.
inline std::string numbered(std::size_t number, std::size_t largest)
{
  const std::size_t width = std::max<std::size_t>(5, std::to_string(largest).size());
  const std::string digits = std::to_string(number);
  return std::string(width - std::min(width, digits.size()), '0') + digits;
}

} // namespace cactus
