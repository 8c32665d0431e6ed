// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace cactus
{

/// Bytes that this machine can still give to this process without swapping.
std::uint64_t availableMemory();

/// Throws OutOfMemory unless `bytes` fit into what is available. `what` starts the message ("VoxelSize 0.01 needs a grid of …");
/// `advice` ends it ("choose a larger VoxelSize").
void requireMemory(double bytes, const std::string& what, const std::string& advice);

} // namespace cactus
