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

/// Records of all processes of a team, each of which adds to a RecordLog of its own: FOLDER/NAME is the first one's, and
/// FOLDER/NAME-00001 and so on are the others'. Any number of processes goes on with what any other has left.
class TeamLog
{
public:
  /// In a folder that the first process finds. Processes that share it make theirs together. Throws as RecordLog does.
  TeamLog(std::filesystem::path folder, std::string name, std::string identity, const Sharing& sharing);

  /// What was there when it was opened, process by process; once.
  std::vector<std::string> takeRecords();
  /// Several threads may add. Throws FileError.
  void add(const std::string& record) { this->Own->add(record); }
  /// Whether no process has added anything. Only while no other one is at work.
  bool isEmpty() const;
  /// Removes the files. Nothing may be added any more.
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
