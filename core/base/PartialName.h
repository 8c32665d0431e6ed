// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cactus
{

/// The name that something has while it is written: `name.partial-BBBBBBBB-RRRRRRRR`, where B tells one start of one machine from
/// another and R is drawn by the system, so that it cannot be foreseen. A long name is cut short, to stay one that file systems
/// take.
std::string partialName(const std::string& name);

/// Whether a thing has a name that partialName(name) gives.
bool isPartialName(const std::string& candidate, const std::string& name);

/// The name of which this is a partial one, where it is one of a name that was not cut short; else itself.
std::string wholeName(const std::string& candidate);

/// Takes the lock that says that this process, which lives, uses the file; it ends with the process. Gives false where another
/// has it, or the file system knows no locks.
bool lockForWriting(int descriptor);

/// Whether a partial file, whose lock could be had, was left by a process that is gone: one of this start of this machine is,
/// by its lock. Another machine's locks may be unknown to this one, so that its files have to have been left alone for a day.
bool isStale(const std::filesystem::path& partial, int lockedDescriptor);

/// Things in `folder` with a partial name of `name`, sorted; none where the folder cannot be read.
std::vector<std::filesystem::path> partialsOf(const std::filesystem::path& folder, const std::string& name);

} // namespace cactus
