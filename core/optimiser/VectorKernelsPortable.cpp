// SPDX-License-Identifier: BSD-3-Clause
// For any machine: vectors of 16 bytes.
#define CACTUS_KERNELS portableKernels
#define CACTUS_DOUBLES 2
#include "optimiser/VectorKernelsBody.h"
