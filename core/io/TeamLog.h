// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Sharing.h"
#include "io/RecordLog.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cactus
{

/// The records of all processes of a team, each of which appends to its own RecordLog: FOLDER/NAME for the first one, and
/// FOLDER/NAME-00001 and so on for the others. Any number of processes continues the logs that any others have left.
class TeamLog
{
public:
  /// Opens the logs in a folder that exists for the first process. Collective: processes that share it make theirs together.
  /// Throws as RecordLog does.
  TeamLog(std::filesystem::path folder, std::string name, std::string identity, const Sharing& sharing);

  /// Returns the records that existed when it was opened, process by process; once.
  std::vector<std::string> takeRecords();
  /// Appends a record. Thread-safe. Throws FileError.
  void add(const std::string& record) { this->Own->add(record); }
  /// Tells whether no process has added anything. Call it only while no other process runs.
  bool isEmpty() const;
  /// Removes the files. Nothing may be added afterwards.
  void remove();

private:
  std::vector<std::filesystem::path> files() const;

  std::filesystem::path Folder;
  std::string Name;
  std::string Identity;
  std::optional<RecordLog> Own;
  std::vector<std::string> Found;
};

} // namespace cactus
