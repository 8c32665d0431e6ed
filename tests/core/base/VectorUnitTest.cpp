// SPDX-License-Identifier: BSD-3-Clause
#include "base/VectorUnit.h"

#include <gtest/gtest.h>

#if defined(__x86_64__) && !defined(__clang__) && __GNUC__ >= 12
// Guarantee: the level of x86-64 derived from single features is the one that a newer compiler reports by name.
TEST(VectorUnit, KnowsTheLevelOfThisMachine)
{
  const std::size_t levels = (__builtin_cpu_supports("x86-64-v3") ? 1u : 0u) + (__builtin_cpu_supports("x86-64-v4") ? 1u : 0u);
  EXPECT_EQ(cactus::runnableVectorUnits(), 1u + levels);
}
#endif

// Guarantee: there is always a version to run.
TEST(VectorUnit, HasAtLeastOneUnit)
{
  EXPECT_GE(cactus::runnableVectorUnits(), 1u);
  EXPECT_LE(cactus::runnableVectorUnits(), 3u);
}
