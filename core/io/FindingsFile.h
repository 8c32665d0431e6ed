// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Recollection.h"
#include "io/TeamLog.h"

#include <filesystem>
#include <string>
#include <unordered_map>

namespace cactus
{

/// A FindingsStore in a folder: FOLDER/findings, and FOLDER/findings-00001 and so on for the other processes of a team. Of
/// several findings of the same name the last one counts. Throws as TeamLog does.
class FindingsFile : public FindingsStore
{
public:
  FindingsFile(const std::filesystem::path& folder, const std::string& identity, const Sharing& sharing);

  std::optional<std::string> take(const std::string& name) override;
  void keep(const std::string& name, const std::string& bytes) override;
  /// Tells whether there were findings when it was opened.
  bool foundSome() const { return this->FoundSome; }
  /// Tells whether no process has kept anything. Call it only while no other process runs.
  bool isEmpty() const { return this->Log.isEmpty(); }
  /// Removes the files. Nothing may be kept afterwards.
  void remove() { this->Log.remove(); }

private:
  TeamLog Log;
  std::unordered_map<std::string, std::string> Known;
  bool FoundSome = false;
};

} // namespace cactus
