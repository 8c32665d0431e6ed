// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PosixFile.h"
#include "io/FolderInspection.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cactus
{

/// A folder beside the place of another one, in which that is written. It is told by its name (see partialName()) and a lock that
/// the living process holds:
///
///   NAME.partial-…/lock
///   NAME.partial-…/substrate   the new folder; after an exchange, the former one
///   NAME.partial-…/former      the former one, if it was moved here in a step of its own
///
/// What a process that was killed has left of this kind is looked for by recoverStaging().
class StagingFolder
{
public:
  /// Makes one for `place`, which is whole. Throws FileError.
  explicit StagingFolder(const std::filesystem::path& place);
  /// The one that another process has made for `place`, and holds.
  StagingFolder(std::filesystem::path place, std::filesystem::path container);
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  const std::filesystem::path& container() const { return this->Container; }
  std::filesystem::path substrate() const;
  std::filesystem::path former() const;

  void makeFolder(const std::string& path) const;
  /// Writes a new file (path relative to the new folder) and gives its SHA-256. Throws FileError.
  std::string write(const std::string& path, const std::string& text) const;
  /// The same for a file that `writer`, which is given its whole path, writes by itself.
  std::string writeBy(const std::string& path, const std::function<void(const std::string&)>& writer) const;
  /// Brings everything to the disk.
  void synchronise() const;

private:
  bool make();
  [[noreturn]] void fail(const std::string& why) const;

  std::filesystem::path Place;
  std::filesystem::path Container;
  Descriptor Lock;
};

/// Removes what is in a staging folder and is as we wrote it, and the folder if that is all. Adds a sentence to `leftovers` for
/// what is kept because it holds what is the user's. What was known of the folder in it (`earlier`) saves reading it again.
void cleanStaging(const std::filesystem::path& container, const FolderInspection& earlier, std::vector<std::string>& leftovers);

/// Puts back a former folder whose place is empty, and cleans the staging folders of processes that are no more.
void recoverStaging(const std::filesystem::path& place, std::vector<std::string>& leftovers);

} // namespace cactus
