// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PosixFile.h"

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

namespace cactus
{

/// A file that appears under its name whole or not at all: it is written beside it, under a name that cannot be foreseen, brought
/// to the disk, and renamed by commit(). A link stays, and what it leads to is replaced. The file has the permissions of the one
/// that it replaces, or those that the umask gives. What a process that was killed has left of the same file is removed.
class AtomicFile
{
public:
  /// Opens a temporary file beside `path` (or beside what it links to). Throws FileError where that cannot be written, and where
  /// `path` is a folder, a device or write-protected.
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Removes what was written unless it was committed.
  ~AtomicFile();

  /// Numbers are written as in the C locale, whatever the program's.
  std::ostream& stream() { return *this->Stream; }
  /// Closes and renames; throws FileError where something could not be written.
  void commit();

private:
  [[noreturn]] void fail(const std::string& why) const;
  void open();

  std::string Path;
  std::filesystem::path Place; ///< where links lead to
  std::filesystem::path Temporary;
  Descriptor File;
  std::unique_ptr<DescriptorBuffer> Buffer;
  std::unique_ptr<std::ostream> Stream;
  bool Committed = false;
};

} // namespace cactus
