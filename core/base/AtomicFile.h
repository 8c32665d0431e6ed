// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PosixFile.h"

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

namespace cactus
{

/// A file that appears under its name whole or not at all. It is written beside that name under an unpredictable one, flushed to
/// the disk, and renamed by commit(). A symbolic link stays; its target is replaced. The new file has the permissions of the one
/// that it replaces, or else those that the umask gives. Leftovers of killed processes for the same file are removed.
class AtomicFile
{
public:
  /// Opens a temporary file beside `path` (or beside its target if it is a link). Throws FileError if that cannot be written, or
  /// if `path` is a folder, a device or write-protected.
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Removes what was written unless it was committed.
  ~AtomicFile();

  /// Writes numbers as in the C locale, whatever the program's locale is.
  std::ostream& stream() { return *this->Stream; }
  /// Closes and renames; throws FileError if something could not be written.
  void commit();

private:
  [[noreturn]] void fail(const std::string& why) const;
  void open();

  std::string Path;
  std::filesystem::path Place; ///< `path` with its links followed
  std::filesystem::path Temporary;
  Descriptor File;
  std::unique_ptr<DescriptorBuffer> Buffer;
  std::unique_ptr<std::ostream> Stream;
  bool Committed = false;
};

} // namespace cactus
