// SPDX-License-Identifier: BSD-3-Clause
#include "VectorKernels.h"

namespace cactus
{

#if defined(__x86_64__)
namespace
{

// Clang knows the levels by name from version 17 on; before, the features are asked for one by one.
#if defined(__clang__) && __clang_major__ < 17
bool supportsX86V3()
{
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
         __builtin_cpu_supports("fma");
}

bool supportsX86V4()
{
  return supportsX86V3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#else
bool supportsX86V3()
{
  return __builtin_cpu_supports("x86-64-v3");
}

bool supportsX86V4()
{
  return __builtin_cpu_supports("x86-64-v4");
}
#endif

} // namespace
#endif

const VectorKernels& vectorKernels()
{
#if defined(__x86_64__)
  static const VectorKernels& best = []() -> const VectorKernels&
  {
    __builtin_cpu_init();
    if (supportsX86V4())
    {
      return x86V4Kernels;
    }
    return supportsX86V3() ? x86V3Kernels : portableKernels;
  }();
  return best;
#else
  return portableKernels;
#endif
}

} // namespace cactus
