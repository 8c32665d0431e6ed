// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PosixFile.h"

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// A log file to which records (bytes) are appended, and which keeps all complete records if its writer is killed. Each has its
/// length and Hash64; the next writer cuts off a half-written one. One process at a time may have it open.
class RecordLog
{
public:
  /// Opens the file, or creates it. `identity` says what it belongs to. Throws InvalidInput if the file has another one, and
  /// FileError if the file cannot be used, or another process uses it.
  RecordLog(const std::string& path, const std::string& identity);

  /// Returns the records that the file had when it was opened; once.
  std::vector<std::string> takeRecords() { return std::exchange(this->Records, {}); }
  /// Returns the records of a file that another process may have open, or has left. Throws as the constructor does; a missing or
  /// empty file has no records.
  static std::vector<std::string> recordsOf(const std::string& path, const std::string& identity);
  /// Appends a record. Thread-safe. Throws FileError.
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
