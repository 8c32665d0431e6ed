// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PosixFile.h"

#include <filesystem>
#include <string>

namespace cactus
{

/// Returns the name of a file while it is written: `name.cactus-partial`.
std::string partialName(const std::string& name);

/// Returns the name that `candidate`, which may have more after it, is a partial name of; returns `candidate` if it is none.
std::string wholeName(const std::string& candidate);

/// Takes the lock that says that this live process uses the file; it ends with the process. Returns false if another process has
/// it, or if the file system has no locks.
bool lockForWriting(int descriptor);

/// Opens a file that only processes of ours write, one at a time, with its lock; makes it if it is not there, with this `mode`
/// less the umask. What a killed process has left is taken. Returns none if there is no folder for it. Throws FileError, which
/// begins with `what` and says if another process has it or if it is not ours.
Descriptor takePartial(const std::filesystem::path& path, mode_t mode, const std::string& what);

} // namespace cactus
