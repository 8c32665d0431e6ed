// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Sharing.h"
#include "optimiser/CapsuleRuns.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// For each process, which of this one's boxes may overlap one of its own, in increasing order: all that do, and others not far
/// from it. None for this process itself. Every process has to come here.
///
/// Processes tell each other which cells of a coarse grid their boxes reach; boxes that overlap have a cell in common.
std::vector<std::vector<std::size_t>> boxesNearOthers(const std::vector<RunBox>& boxes, const Sharing& sharing);

} // namespace cactus
