// SPDX-License-Identifier: BSD-3-Clause
// The loops of VectorKernels.h for one vector unit. Included once by each source file that is compiled for one, with
// CACTUS_DOUBLES the doubles in a vector and CACTUS_KERNELS the name to define. Such a file must not leave behind an inline
// function that others share, since the linker might take the version for a machine that is not there: nothing here, nor in what
// is included here, calls one that is not forced inline.
#include "optimiser/OverlapKernel.h"
#include "optimiser/SearchKernels.h"

namespace cactus
{

const VectorKernels CACTUS_KERNELS = { evaluateCapsule, gatherNear, selectNeighbours, selectBoxes, sortKeys, selectFromRuns };

} // namespace cactus
