// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Recollection.h"
#include "io/TeamLog.h"

#include <filesystem>
#include <string>
#include <unordered_map>

namespace cactus
{

/// Findings in a folder: FOLDER/findings, and FOLDER/findings-00001 and so on of processes of a team beside the first. Of those
/// of the same name the last one counts. Throws as TeamLog does.
class FindingsFile : public FindingsStore
{
public:
  FindingsFile(const std::filesystem::path& folder, const std::string& identity, const Sharing& sharing);

  std::optional<std::string> take(const std::string& name) override;
  void keep(const std::string& name, const std::string& bytes) override;
  /// Whether something was there when it was opened.
  bool foundSome() const { return this->FoundSome; }
  /// Whether no process has kept anything. Only while no other one is at work.
  bool isEmpty() const { return this->Log.isEmpty(); }
  /// Removes the files. Nothing may be kept any more.
  void remove() { this->Log.remove(); }

private:
  TeamLog Log;
  std::unordered_map<std::string, std::string> Known;
  bool FoundSome = false;
};

} // namespace cactus
