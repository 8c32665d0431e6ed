// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/FolderInspection.h"

#include <filesystem>
#include <string>

namespace cactus
{

// Where a substrate folder may be written. All throw FileError, which names the folder and says what to do.

[[noreturn]] void cannotWriteFolder(const std::string& folder, const std::string& why);

/// Whether there is anything of this name, if only a broken link.
bool isThere(const std::filesystem::path& path);

/// The place that a FolderName names: whole, without links and dots. Throws if there cannot be a folder.
std::filesystem::path placeOf(const std::string& folder);

/// Throws for a folder that this process runs in, or that holds it: exchanged for another, it would be gone under its feet. And
/// for one at which a file system is mounted, which cannot be exchanged.
void requireMovable(const std::filesystem::path& place);

/// Throws if a program runs in the folder, such as a simulation that has yet to write its results into it.
void requireNobodyIn(const std::filesystem::path& place);

/// Throws if what is in a place is not a substrate folder as we wrote it, or an empty folder.
void requireReplaceable(const std::filesystem::path& place, const FolderInspection& found);

/// Everything of the user's in an inspected folder, for a person who has to decide on it.
std::string contentsOf(const FolderInspection& found);

} // namespace cactus
