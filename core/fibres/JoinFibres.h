// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <vector>

namespace cactus
{

/// Appends fibres to others of one substrate. If one of their fibre ids is in use, all of these are moved above the largest one
/// in use; the same holds for bundle ids. The domain of `added` is ignored. Throws InvalidInput if no id is free.
void appendFibres(const Fibres& added, Fibres& all);

/// Joins fibres into one substrate, in their order. Throws InvalidInput if the domains differ, or as appendFibres() does.
Fibres joinFibres(std::vector<Fibres> inputs);

/// Tells whether two domains are equal to 1e-9 µm.
bool isSame(const Domain& a, const Domain& b);

} // namespace cactus
