// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -march=x86-64-v3, see CMakeLists.txt.
#if defined(__x86_64__)
#define CACTUS_KERNELS x86V3Kernels
#define CACTUS_DOUBLES 4
#include "optimiser/VectorKernelsBody.h"
#endif
