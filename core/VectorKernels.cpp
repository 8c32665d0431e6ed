// SPDX-License-Identifier: BSD-3-Clause
#include "VectorKernels.h"

namespace cactus
{

const VectorKernels& vectorKernels()
{
#if defined(__x86_64__)
  static const VectorKernels& best = []() -> const VectorKernels&
  {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("x86-64-v4"))
    {
      return x86V4Kernels;
    }
    return __builtin_cpu_supports("x86-64-v3") ? x86V3Kernels : portableKernels;
  }();
  return best;
#else
  return portableKernels;
#endif
}

} // namespace cactus
