// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <string>

namespace cactus
{

/// A text file that appears under its name whole or not at all: it is written beside it and renamed by commit().
class AtomicFile
{
public:
  /// Opens a temporary file beside `path`; throws FileError where that cannot be written.
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Removes what was written unless it was committed.
  ~AtomicFile();

  std::ofstream& stream() { return this->Stream; }
  /// Closes and renames; throws FileError where something could not be written.
  void commit();

private:
  std::string Path;
  std::string Temporary;
  std::ofstream Stream;
  bool Committed = false;
};

} // namespace cactus
