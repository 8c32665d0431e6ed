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

std::vector<const VectorKernels*> runnableVectorKernels()
{
  std::vector<const VectorKernels*> runnable{ &portableKernels };
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (supportsX86V3())
  {
    runnable.push_back(&x86V3Kernels);
  }
  if (supportsX86V4())
  {
    runnable.push_back(&x86V4Kernels);
  }
#endif
  return runnable;
}

const VectorKernels& vectorKernels()
{
  static const VectorKernels& best = *runnableVectorKernels().back();
  return best;
}

} // namespace cactus
