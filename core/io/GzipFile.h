// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>

struct gzFile_s; // zlib's

namespace cactus
{

/// Reads a file from its beginning; one packed by gzip is unpacked.
class GzipReader
{
public:
  /// Throws FileError.
  explicit GzipReader(std::string path);

  /// Reads up to `count` bytes and returns how many there were; fewer only at the end. Throws FileError for a damaged file.
  std::size_t read(char* to, std::size_t count);
  /// Passes over bytes, and tells whether there were as many.
  bool skip(std::uint64_t count);

private:
  std::string Path;
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> File;
};

/// Tells by its first bytes whether a file is packed by gzip.
bool isGzip(const std::string& path);

/// Returns the first bytes of a file, at most `count` of them; of a file packed by gzip, those of its content. Empty for what is
/// no regular file or cannot be read.
std::string beginningOfFile(const std::string& path, std::size_t count);

/// Writes the content of a file packed by gzip to the stream. Throws FileError (no such file, truncated, damaged), OutOfMemory
/// and Cancelled.
void unpackGzip(const std::string& path, std::ostream& to, const Context& context = {});

} // namespace cactus
