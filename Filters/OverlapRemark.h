// SPDX-License-Identifier: BSD-3-Clause
// The remark on fibres that overlap before growth.
#pragma once

#include "fibres/Fibres.h"

#include <string>

class vtkDataObject;

namespace cactus
{

/// Returns a remark if the fibres of `input` penetrate each other: if their optimiser has said so (field data Converged is 0), or
/// if they come from no optimiser or from several, or were changed since, and capsules of different fibres overlap by more than a
/// hundredth of their radii. Else empty. `fibres` are those of `input`.
std::string remarkOnOverlaps(vtkDataObject* input, const Fibres& fibres, int threads);

} // namespace cactus
