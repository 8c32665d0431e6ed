// SPDX-License-Identifier: BSD-3-Clause
// Paths and contents of test files.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>
#include <vector>

namespace cactus_testing
{

/// Returns a path for this process alone: the same test may run in several builds at once.
inline std::string scratchPath(const std::string& name)
{
  return ::testing::TempDir() + "cactus-" + std::to_string(::getpid()) + '-' + name;
}

/// All bytes of a file.
inline std::string contentOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

/// Tests that write into a folder of their own: in memory if possible, since some of them write hundreds of folders.
class ScratchFolder : public ::testing::Test
{
protected:
  ScratchFolder()
    : Scratch((::access("/dev/shm", W_OK) == 0 ? "/dev/shm/" : ::testing::TempDir()) + "cactus-" + std::to_string(::getpid()))
  {
    std::filesystem::remove_all(this->Scratch);
    std::filesystem::create_directories(this->Scratch);
  }
  ~ScratchFolder() override
  {
    std::filesystem::permissions(this->Scratch, std::filesystem::perms::owner_all);
    std::filesystem::remove_all(this->Scratch);
  }

  using Names = std::vector<std::string>;
  /// Returns what is in it, sorted.
  Names entries() const
  {
    Names names;
    for (const auto& entry : std::filesystem::directory_iterator(this->Scratch))
    {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  const std::filesystem::path Scratch;
};

} // namespace cactus_testing
