// SPDX-License-Identifier: BSD-3-Clause
#include "base/VectorUnit.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace cactus
{

#if defined(__x86_64__)
namespace
{

// Checks feature by feature: g++ before 12 and clang before 18 do not know the levels of x86-64 by name, and clang does not know
// all features.
bool supportsX86V3()
{
  unsigned int a = 0;
  unsigned int b = 0;
  unsigned int first = 0;
  unsigned int extended = 0;
  unsigned int d = 0;
  if (__get_cpuid(1, &a, &b, &first, &d) == 0 || __get_cpuid(0x80000001u, &a, &b, &extended, &d) == 0)
  {
    return false;
  }
  const bool movbe = (first & (1u << 22u)) != 0;
  const bool f16c = (first & (1u << 29u)) != 0;
  const bool lzcnt = (extended & (1u << 5u)) != 0;
  // These also ask the operating system.
  return movbe && f16c && lzcnt && __builtin_cpu_supports("popcnt") && __builtin_cpu_supports("sse4.2") &&
         __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
         __builtin_cpu_supports("fma");
}

bool supportsX86V4()
{
  return supportsX86V3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}

} // namespace
#endif

std::size_t runnableVectorUnits()
{
#if defined(__x86_64__)
  __builtin_cpu_init();
  return supportsX86V4() ? 3 : supportsX86V3() ? 2 : 1;
#else
  return 1;
#endif
}

} // namespace cactus
