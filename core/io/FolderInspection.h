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

/// A substrate folder on the disk, held against what its manifest says was written: what in it is the user's. Paths are relative
/// to the folder and sorted.
struct FolderInspection
{
  bool exists = false; ///< and is a folder
  bool empty = false;
  bool isSubstrate = false;                   ///< it has a manifest of ours
  bool isFinished = false;                    ///< and that manifest says what was written
  std::vector<std::string> added;             ///< not written by us: files, links, folders (with a slash at the end)
  std::vector<std::string> changed;           ///< written by us, and no longer as it was
  std::vector<std::string> writeProtected;    ///< files and folders
  std::map<std::string, struct stat> files;   ///< as written, and how the disk had them when they were read
  std::map<std::string, struct stat> folders; ///< ours, "" for the folder itself
  std::time_t started = 0;                    ///< s, by the clock

  /// Nothing in it is anybody's but ours.
  bool asWritten() const { return added.empty() && changed.empty() && writeProtected.empty(); }
};

/// Looks at a folder and reads every file that the manifest lists, except those that `earlier`, an inspection of the same
/// folder, has read and that have not been touched since. Throws FileError where something in it cannot be read, and Cancelled.
FolderInspection inspectFolder(
  const std::filesystem::path& folder, const Context& context = {}, const FolderInspection& earlier = {});

/// Removes what an inspection found to be as written, if nobody has touched it since, the manifest last; and the folders that are
/// empty then. Whether nothing is left.
bool removeInspected(const std::filesystem::path& folder, const FolderInspection& inspection);

/// Up to five names, and how many more there are.
std::string listed(const std::vector<std::string>& names);

} // namespace cactus
