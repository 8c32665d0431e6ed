// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Sharing.h"
#include "optimiser/CapsuleRuns.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// Returns for each process, in increasing order, which of this one's boxes may overlap one of its own: all that do, and some
/// close to it. Empty for this process itself. Collective.
///
/// Processes exchange which cells of a coarse grid their boxes touch; boxes that overlap have a cell in common.
std::vector<std::vector<std::size_t>> boxesNearOthers(const std::vector<RunBox>& boxes, const Sharing& sharing);

} // namespace cactus
