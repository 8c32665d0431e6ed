// SPDX-License-Identifier: BSD-3-Clause
// What is said of fibres that are to grow although they overlap.
#pragma once

#include "fibres/Fibres.h"

#include <string>

class vtkDataObject;

namespace cactus
{

/// A remark where the fibres of `input` penetrate each other: where the optimiser that they come from has said so (field data
/// Converged is 0), or where they come from none, or from several, or were changed since, and capsules of different fibres have
/// more than a hundredth of their radii in common. Empty else. `fibres` are those of `input`.
std::string remarkOnOverlaps(vtkDataObject* input, const Fibres& fibres, int threads);

} // namespace cactus
