// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/SubstrateManifest.h"

#include <ctime>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <sys/stat.h>

namespace cactus
{

/// A substrate folder on the disk compared with its manifest, which shows what belongs to the user. Paths are relative to the
/// folder and sorted.
struct FolderInspection
{
  bool exists = false; ///< it exists and is a folder
  bool empty = false;
  bool isSubstrate = false;                   ///< it has a manifest of ours
  bool isFinished = false;                    ///< the manifest lists the written files
  std::vector<std::string> added;             ///< not written by us: files, links, folders (with a slash at the end)
  std::vector<std::string> changed;           ///< written by us, but changed since
  std::vector<std::string> writeProtected;    ///< files and folders
  std::map<std::string, struct stat> files;   ///< files as written, with their status on the disk when they were read
  std::map<std::string, struct stat> folders; ///< ours, "" for the folder itself
  std::time_t started = 0;                    ///< s, start of the inspection by the clock

  /// Tells whether nothing in it belongs to the user.
  bool asWritten() const { return added.empty() && changed.empty() && writeProtected.empty(); }
};

/// Inspects a folder and reads every file that the manifest lists, except those that `earlier`, an inspection of the same folder,
/// has read and that are untouched since. Throws FileError if something in it cannot be read, and Cancelled.
FolderInspection inspectFolder(
  const std::filesystem::path& folder, const Context& context = {}, const FolderInspection& earlier = {});

/// Removes the files that an inspection found to be as written, if they are untouched since, the manifest last, and then empty
/// folders. Returns whether nothing is left.
bool removeInspected(const std::filesystem::path& folder, const FolderInspection& inspection);

/// Returns up to five names, and how many more there are.
std::string listed(const std::vector<std::string>& names);

} // namespace cactus
