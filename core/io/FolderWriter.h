// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/StagingFolder.h"
#include "io/SubstrateManifest.h"

#include <functional>
#include <string>

namespace cactus
{

/// Writes the files of a folder, and records them for its manifest.
class FolderWriter
{
public:
  explicit FolderWriter(const StagingFolder& folder)
    : Folder(folder)
  {
  }
  void makeFolder(const std::string& path)
  {
    this->Folder.makeFolder(path);
    this->Written.folders.insert(path);
  }
  void write(const std::string& path, const std::string& text) { this->remember(path, this->Folder.write(path, text)); }
  void writeBy(const std::string& path, const std::function<void(const std::string&)>& how)
  {
    this->remember(path, this->Folder.writeBy(path, how));
  }
  void remember(const std::string& path, const std::string& checksum) { this->Written.checksums[path] = checksum; }
  const StagingFolder& folder() const { return this->Folder; }
  const WrittenFiles& written() const { return this->Written; }

private:
  const StagingFolder& Folder;
  WrittenFiles Written;
};

} // namespace cactus
