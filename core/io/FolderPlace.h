// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/FolderInspection.h"

#include <filesystem>
#include <string>

namespace cactus
{

// Checks of where a substrate folder may be written. All throw FileError, which names the folder and says what to do.

[[noreturn]] void cannotWriteFolder(const std::string& folder, const std::string& why);

/// Tells whether anything of this name exists, even a broken link.
bool isThere(const std::filesystem::path& path);

/// Returns the absolute path of a FolderName, without links and dots. Throws if there cannot be a folder.
std::filesystem::path placeOf(const std::string& folder);

/// Throws for this process's working directory and the folders that contain it: then it would no longer exist. Also
/// throws for a mount point, which cannot be renamed.
void requireMovable(const std::filesystem::path& place);

/// Inspects a folder that is at `where`, or has been moved there from its place. Throws unless it is a substrate folder as we
/// wrote it, an empty folder, or not there; and Cancelled.
FolderInspection inspectReplaceable(const std::filesystem::path& place, const std::filesystem::path& where,
  const Context& context, const FolderInspection& earlier = {});

/// Returns a list of the user's files in an inspected folder, for the user to decide on.
std::string contentsOf(const FolderInspection& found);

} // namespace cactus
