// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cactus
{

/// Returns the name of a file while it is written: `name.partial-` and 16 digits drawn by the system, so that it cannot be
/// foreseen. A long name is cut to a length that file systems accept.
std::string partialName(const std::string& name);

/// Tells whether `candidate` is a name that partialName(name) may return.
bool isPartialName(const std::string& candidate, const std::string& name);

/// Returns the name that `candidate` is a partial name of; returns `candidate` if it is none or if the name was cut short.
std::string wholeName(const std::string& candidate);

/// Takes the lock that says that this live process uses the file; it ends with the process. Returns false if another process has
/// it, or if the file system has no locks.
bool lockForWriting(int descriptor);

/// Returns the entries of `folder` with a partial name of `name`, sorted; none if the folder cannot be read.
std::vector<std::filesystem::path> partialsOf(const std::filesystem::path& folder, const std::string& name);

} // namespace cactus
