// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/PosixFile.h"
#include "io/FolderInspection.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cactus
{

/// A substrate folder that appears under its name whole or not at all, and takes the place of one that is there only if nothing
/// in that is the user's.
///
/// It is written into a folder beside its place (see partialName) and then changed for what is there in one step of the file
/// system, so that the name holds a whole folder at any time, even if the process is killed. Only then is the former one removed,
/// file by file, each as it is in its manifest. Beside the place there are meanwhile
///
///   NAME.partial-…/lock        held by the living process
///   NAME.partial-…/substrate   the new folder; after the exchange, the former one
///   NAME.partial-…/former      the former one, on file systems that cannot exchange (NFS) and need two steps
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
  const std::filesystem::path& path() const { return this->Staging; }

  void makeFolder(const std::string& path);
  /// Writes a new file (path relative to the folder) and gives its SHA-256. Throws FileError.
  std::string write(const std::string& path, const std::string& text) const;
  /// The same for a file that `writer`, which is given its whole path, writes by itself.
  std::string writeBy(const std::string& path, const std::function<void(const std::string&)>& writer) const;

  /// Brings everything to the disk and puts it in its place. Throws FileError as the constructor does: the user may have changed
  /// something meanwhile.
  void commit(const Context& context = {});

  /// What earlier writes have left beside the place and is kept, because it holds what is the user's: a sentence for each.
  const std::vector<std::string>& leftovers() const { return this->Leftovers; }

private:
  [[noreturn]] void fail(const std::string& why) const;
  void makeContainer();
  void recover();
  void inspectPlace(const Context& context);
  void requireReplaceable(const FolderInspection& found) const;
  void clean(const std::filesystem::path& container, const FolderInspection& earlier);
  void makeAlike(const FolderInspection& former) const;
  bool exchange(const std::filesystem::path& former) const;
  void replace(const Context& context);
  void synchroniseAll() const;

  std::filesystem::path Place;
  std::filesystem::path Container;
  std::filesystem::path Staging;
  Descriptor Lock;
  FolderInspection Former; ///< what is in the place
  std::vector<std::string> Leftovers;
};

} // namespace cactus
