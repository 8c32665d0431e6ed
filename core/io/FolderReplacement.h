// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/FolderInspection.h"
#include "io/StagingFolder.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cactus
{

/// A substrate folder that appears under its name whole or not at all, and replaces an existing one only if everything in that is
/// as we wrote it.
///
/// It is written into a folder beside its place (see StagingFolder) and then exchanged with the existing one in one step of the
/// file system, so that the name refers to a whole folder at any time, even if the process is killed. Only then is the former
/// folder removed, file by file, each as listed in its manifest. File systems that cannot exchange two folders (NFS) need two
/// steps.
///
/// The next write finds the leftovers of a killed process: a former folder whose place is empty is put back; the rest is removed
/// if it is as we wrote it, and named if it is not.
class FolderReplacement
{
public:
  /// `folder` may be relative, a link to a folder, or end in slashes; its parent folder has to exist. Throws FileError if it
  /// cannot be written or holds the user's files, by name; and Cancelled.
  explicit FolderReplacement(const std::string& folder, const Context& context = {});
  FolderReplacement(const FolderReplacement&) = delete;
  FolderReplacement& operator=(const FolderReplacement&) = delete;
  /// Removes what was written unless it was committed.
  ~FolderReplacement();

  /// Returns the folder for the files until they are committed.
  const StagingFolder& staging() const { return *this->Staging; }

  /// Flushes everything to the disk and puts it in its place. Throws FileError as the constructor does: the user may have changed
  /// something meanwhile.
  void commit(const Context& context = {});

  /// Returns a sentence for each leftover of earlier writes beside the place that is kept because it holds the user's files.
  const std::vector<std::string>& leftovers() const { return this->Leftovers; }

private:
  [[noreturn]] void fail(const std::string& why) const;
  void inspectPlace(const Context& context);
  bool exchange() const;
  void replace(const Context& context);

  std::filesystem::path Place;
  std::optional<StagingFolder> Staging; ///< until all files are in place
  FolderInspection Former;              ///< the folder in the place
  std::vector<std::string> Leftovers;
};

} // namespace cactus
