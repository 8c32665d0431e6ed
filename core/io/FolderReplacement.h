// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/PosixFile.h"
#include "io/FolderInspection.h"
#include "io/FolderWriter.h"

#include <filesystem>
#include <string>

namespace cactus
{

/// A substrate folder that appears under its name whole or not at all, and replaces an existing one only if everything in that is
/// as we wrote it.
///
/// It is written into NAME.partial (see FolderWriter), beside its place. Then the existing folder is moved to
/// NAME.partial/former, the new one to the place, and the former one is removed, file by file, each as listed in its manifest.
/// The next write finds what a killed process has left: it puts a former folder back whose place is empty, and removes the rest
/// if all of it is listed as ours.
class FolderReplacement
{
public:
  /// `folder` may be relative, a link to a folder, or end in slashes; its parent folder has to exist. Throws FileError if it
  /// cannot be written, holds the user's files, by name, or if another process is writing it; and Cancelled.
  explicit FolderReplacement(const std::string& folder, const Context& context = {});
  FolderReplacement(const FolderReplacement&) = delete;
  FolderReplacement& operator=(const FolderReplacement&) = delete;
  /// Removes what was written unless it was committed.
  ~FolderReplacement();

  /// Returns NAME.partial, for a FolderWriter.
  const std::filesystem::path& container() const { return this->Container; }

  /// Flushes everything to the disk and puts it in its place. Throws FileError as the constructor does: the user may have changed
  /// something meanwhile.
  void commit(const Context& context = {});

private:
  explicit FolderReplacement(std::filesystem::path place);
  [[noreturn]] void fail(const std::string& why) const;
  void hold();
  std::string clean();
  void putInPlace(const Context& context);
  void release();

  std::filesystem::path Place;
  std::filesystem::path Container;
  Descriptor List;         ///< locked while this process writes
  FolderInspection Former; ///< the folder in the place
};

} // namespace cactus
