// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PosixFile.h"
#include "base/Recollection.h"
#include "base/Sharing.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace cactus
{

/// A FindingsStore in a folder. Each process of a team appends to its own file: FOLDER/journal for the first one, and
/// FOLDER/journal-00001 and so on for the others. Any number of processes continues the files that any others have left. All
/// complete records stay if a writer is killed: each has its length and Hash64, and the next writer cuts off a half-written one.
class Journal : public FindingsStore
{
public:
  /// Opens the files in a folder that exists for the first process. `identity` says what they belong to. Collective: processes
  /// that share it make theirs together. Throws InvalidInput if a file has another identity, and FileError if one cannot be used,
  /// or another process uses it.
  Journal(std::filesystem::path folder, std::string identity, const Sharing& sharing);

  std::optional<std::string> take(const std::string& name) override;
  void keep(const std::string& name, const std::string& bytes) override;
  /// Returns a finding that take() has not returned yet, or null.
  const std::string* find(const std::string& name) const;
  /// Tells whether there were findings when it was opened.
  bool foundSome() const { return this->FoundSome; }
  /// Tells whether any process has kept a finding whose name begins like this. Call it only while no other process runs.
  bool holds(const std::string& beginning) const;
  /// Forgets all findings, those of other processes first. Only the first process may call it, and it keeps its lock. Nothing may
  /// be kept afterwards.
  void clear();
  /// Removes the files. Nothing may be kept afterwards.
  void remove();

private:
  using Visit = std::function<void(const std::string& name, const std::string& bytes)>;

  void open(const std::string& name);
  std::size_t read(const std::filesystem::path& path, const Visit& visit) const;
  void readAll(const Visit& visit) const;
  void add(const std::string& record);
  std::vector<std::filesystem::path> files() const;

  std::filesystem::path Folder;
  std::string Identity;
  std::filesystem::path Path; ///< of this process
  Descriptor File;
  std::unordered_map<std::string, std::string> Known;
  bool FoundSome = false;
  std::mutex Mutex;
};

} // namespace cactus
