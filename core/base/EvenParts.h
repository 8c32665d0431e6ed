// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace cactus
{

/// Splits a sequence of non-negative weights into `parts` (1 or more) ranges of about the same weight: the p-th is result[p] …
/// result[p + 1] − 1. An element goes to the range that its middle falls into on the scale of the summed weights; if all weights
/// are 0, all elements go to the first.
std::vector<std::size_t> evenParts(const std::vector<double>& weights, std::size_t parts);

} // namespace cactus
