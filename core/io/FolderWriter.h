// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/SubstrateManifest.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cactus
{

/// Writes the files of a folder that a FolderReplacement, of this or another process, is to put in its place. All paths are
/// relative to that folder; every function throws FileError.
///
///   NAME.partial/substrate           the new folder
///   NAME.partial/cactus-writes.txt   a line for each file and folder in it, written before that is made; the writing process
///                                    holds a lock on it
class FolderWriter
{
public:
  static constexpr char substrateName[] = "substrate";
  static constexpr char listName[] = "cactus-writes.txt";

  /// `place` is the folder's final path, and `container` its NAME.partial.
  FolderWriter(std::filesystem::path place, std::filesystem::path container);

  void makeFolder(const std::string& path);
  /// Writes a file, and records its checksum for the manifest.
  void write(const std::string& path, const std::string& text);
  /// Does the same for a file that `how`, which gets its absolute path, writes itself.
  void writeBy(const std::string& path, const std::function<void(const std::string&)>& how);
  const WrittenFiles& written() const { return this->Written; }

  // Several threads and processes can write files by put() and putBy(), which return the SHA-256, once these are listed.
  void list(const std::vector<std::string>& paths) const;
  std::string put(const std::string& path, const std::string& text) const;
  std::string putBy(const std::string& path, const std::function<void(const std::string&)>& how) const;
  void remember(const std::string& path, const std::string& checksum) { this->Written.checksums[path] = checksum; }

private:
  [[noreturn]] void fail(const std::string& why) const;

  std::filesystem::path Place;
  std::filesystem::path Container;
  std::filesystem::path Folder;
  WrittenFiles Written;
};

} // namespace cactus
