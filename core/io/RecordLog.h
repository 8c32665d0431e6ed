// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PosixFile.h"

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// A file to which records (bytes) are added one by one, and which holds all that were added before its writer was killed. Each
/// has its length and CRC-64; what a writer left half-written is cut off by the next one. One process at a time may have it open.
class RecordLog
{
public:
  /// Opens the file, or makes it. `identity` says what it belongs to. Throws InvalidInput where that is another one, and
  /// FileError where the file cannot be used, or another process uses it.
  RecordLog(const std::string& path, const std::string& identity);

  /// What was in the file when it was opened; once.
  std::vector<std::string> takeRecords() { return std::exchange(this->Records, {}); }
  /// What is in a file that another process may have open, or has left. Throws as the constructor does, but for a file that is
  /// not there or empty, which has no records.
  static std::vector<std::string> recordsOf(const std::string& path, const std::string& identity);
  /// Several threads may add. Throws FileError.
  void add(const std::string& record);

private:
  RecordLog(const std::string& path, Descriptor file);
  std::size_t read();
  bool takeIdentity(const std::string& identity);
  [[noreturn]] void fail(const std::string& why) const;

  std::string Path;
  Descriptor File;
  std::vector<std::string> Records;
  std::mutex Mutex;
};

} // namespace cactus
