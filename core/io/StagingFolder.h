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

/// A folder beside the place of another one, in which the new content is written. It is recognised by its name (see
/// partialName()) and a lock that the living process holds:
///
///   NAME.partial-…/lock
///   NAME.partial-…/substrate   the new folder; after an exchange, the former one
///   NAME.partial-…/former      the former one, if it was moved here in a step of its own
///
/// recoverStaging() finds the leftovers of killed processes.
class StagingFolder
{
public:
  /// Makes one for `place`, an absolute path. Throws FileError.
  explicit StagingFolder(const std::filesystem::path& place);
  /// Refers to the one that another process has made for `place`, and holds.
  StagingFolder(std::filesystem::path place, std::filesystem::path container);
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  const std::filesystem::path& container() const { return this->Container; }
  std::filesystem::path substrate() const;
  std::filesystem::path former() const;

  void makeFolder(const std::string& path) const;
  /// Writes a new file (path relative to the new folder) and returns its SHA-256. Throws FileError.
  std::string write(const std::string& path, const std::string& text) const;
  /// Does the same for a file that `writer`, which gets its absolute path, writes itself.
  std::string writeBy(const std::string& path, const std::function<void(const std::string&)>& writer) const;
  /// Flushes everything to the disk.
  void synchronise() const;

private:
  bool make();
  [[noreturn]] void fail(const std::string& why) const;

  std::filesystem::path Place;
  std::filesystem::path Container;
  Descriptor Lock;
};

/// Removes the content of a staging folder that is as we wrote it, and the folder if nothing else is in it. Adds a sentence to
/// `leftovers` for content that is kept because it belongs to the user. An earlier inspection (`earlier`) saves reading the
/// content again.
void cleanStaging(const std::filesystem::path& container, const FolderInspection& earlier, std::vector<std::string>& leftovers);

/// Puts back a former folder whose place is empty, and cleans the staging folders of dead processes.
void recoverStaging(const std::filesystem::path& place, std::vector<std::string>& leftovers);

} // namespace cactus
