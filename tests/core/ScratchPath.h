// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <unistd.h>

namespace cactus_testing
{

/// A path for this process alone: the same test may run in several builds at once.
inline std::string scratchPath(const std::string& name)
{
  return ::testing::TempDir() + "cactus-" + std::to_string(::getpid()) + '-' + name;
}

} // namespace cactus_testing
