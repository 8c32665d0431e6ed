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

/// A substrate folder that appears under its name whole or not at all, and takes the place of one that is there only if
/// everything in that is as we wrote it.
///
/// It is written into a folder beside its place (see StagingFolder) and then changed for what is there in one step of the file
/// system, so that the name holds a whole folder at any time, even if the process is killed. Only then is the former one removed,
/// file by file, each as it is in its manifest. File systems that cannot exchange two folders (NFS) need two steps.
///
/// What a process that was killed has left so is looked for at the next write: a former folder whose place is empty is put back;
/// the rest is removed as far as it is as we wrote it, and named if it is not.
class FolderReplacement
{
public:
  /// `folder` may be relative, a link to a folder, or end in slashes; the folder that it is in has to exist. Throws FileError
  /// where it cannot be written or holds what is the user's, by name; and Cancelled.
  explicit FolderReplacement(const std::string& folder, const Context& context = {});
  FolderReplacement(const FolderReplacement&) = delete;
  FolderReplacement& operator=(const FolderReplacement&) = delete;
  /// Removes what was written unless it was committed.
  ~FolderReplacement();

  /// Where the files go until they are committed.
  const StagingFolder& staging() const { return *this->Staging; }

  /// Brings everything to the disk and puts it in its place. Throws FileError as the constructor does: the user may have changed
  /// something meanwhile.
  void commit(const Context& context = {});

  /// What earlier writes have left beside the place and is kept, because it holds what is the user's: a sentence for each.
  const std::vector<std::string>& leftovers() const { return this->Leftovers; }

private:
  [[noreturn]] void fail(const std::string& why) const;
  void inspectPlace(const Context& context);
  bool exchange() const;
  void replace(const Context& context);

  std::filesystem::path Place;
  std::optional<StagingFolder> Staging; ///< until all is in its place
  FolderInspection Former;              ///< what is in the place
  std::vector<std::string> Leftovers;
};

} // namespace cactus
