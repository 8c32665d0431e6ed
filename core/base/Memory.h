// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace cactus
{

/// Bytes that this process can still get, without swapping: the least of
///  - what the machine has available (MemAvailable of /proc/meminfo),
///  - what each of its control groups, v1 and v2, leaves to it (limit less what is used; cached files and kernel caches that can
///    be reclaimed count as free),
///  - what its limit on address space (RLIMIT_AS) leaves beside what is mapped,
/// the first two divided by the processes that share them (see setProcessesSharingMemory).
std::uint64_t availableMemory();

/// How many processes of one job work on this machine side by side, and so share its memory; 1 from the start. Whoever knows
/// (the ranks of MPI on one node) says so once. Throws nothing; what is below 1 counts as 1.
void setProcessesSharingMemory(int processes);

/// From here on memory that is freed is kept for what is allocated next, up to 64 MB a thread, where the C library would give it
/// back to the system and fetch it anew: work on one fibre after the other, each of which needs some MB, takes a fifth less time.
/// Of glibc; does nothing elsewhere.
void keepFreedMemory();

/// Its parts: what the machine and its control groups leave to all processes, as the files under `root` (""; tests have others)
/// say, and what is left of this process's limit on address space. The largest number where there is no limit.
std::uint64_t sharedMemoryLeft(const std::string& root);
std::uint64_t availableAddressSpace();

/// Throws OutOfMemory unless `bytes` fit into what is available. `what` starts the message ("VoxelSize 0.01 needs a grid of …");
/// `advice` ends it ("choose a larger VoxelSize").
void requireMemory(double bytes, const std::string& what, const std::string& advice);

} // namespace cactus
