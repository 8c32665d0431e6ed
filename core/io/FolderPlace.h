// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace cactus
{

// Where a substrate folder may be written. All throw FileError, which names the folder and says what to do.

[[noreturn]] void cannotWriteFolder(const std::string& folder, const std::string& why);

/// Returns the absolute path of a FolderName, without links and dots. Throws if there cannot be a folder.
std::filesystem::path placeOf(const std::string& folder);

/// Throws for this process's working directory and the folders that contain it: then it would no longer exist. Also
/// throws for a mount point, which cannot be renamed.
void requireMovable(const std::filesystem::path& place);

} // namespace cactus
