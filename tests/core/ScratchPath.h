// SPDX-License-Identifier: BSD-3-Clause
// Paths and contents of test files.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

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

} // namespace cactus_testing
