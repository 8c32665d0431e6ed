// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace cactus
{

/// Parts a row of things, whose weights are not negative, into `parts` stretches of about the same weight: the p-th of them is
/// result[p] … result[p + 1] − 1. A thing belongs where its middle lies, on a scale of the weights; without any weight all belong
/// to the first. parts: 1 or more.
std::vector<std::size_t> evenParts(const std::vector<double>& weights, std::size_t parts);

} // namespace cactus
