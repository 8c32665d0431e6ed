// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cactus
{

/// A substrate folder on the disk compared with its manifest, which shows what belongs to the user. Paths are relative to the
/// folder and sorted.
struct FolderInspection
{
  bool isSubstrate = false;                ///< it has a manifest of ours
  std::vector<std::string> added;          ///< not written by us: files, links, folders (with a slash at the end)
  std::vector<std::string> changed;        ///< written by us, but changed since
  std::vector<std::string> writeProtected; ///< files and folders
  std::vector<std::string> files;          ///< as written
  std::vector<std::string> folders;        ///< ours

  /// Tells whether nothing in it belongs to the user.
  bool asWritten() const { return added.empty() && changed.empty() && writeProtected.empty(); }
};

/// Inspects a folder, and reads every file that the manifest lists. Throws FileError if something in it cannot be read, and
/// Cancelled.
FolderInspection inspectFolder(const std::filesystem::path& folder, const Context& context = {});

/// Inspects what is at `where`, or has been moved there from its `place`. Throws FileError, which says what to do, unless it is a
/// substrate folder as we wrote it, an empty folder, or not there; and Cancelled.
FolderInspection inspectReplaceable(
  const std::filesystem::path& place, const std::filesystem::path& where, const Context& context);

/// Returns a list of the user's files in an inspected folder, for the user to decide on.
std::string contentsOf(const FolderInspection& found);

/// Removes the files that an inspection found to be as written, the manifest last, and then empty folders. Returns whether
/// nothing is left.
bool removeInspected(const std::filesystem::path& folder, const FolderInspection& inspection);

} // namespace cactus
