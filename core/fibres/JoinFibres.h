// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <vector>

namespace cactus
{

/// Adds fibres to others of one substrate. If one of their fibre ids is in use, all of these are moved above the largest one in
/// use; and so are bundle ids. The domain of `added` does not count. What the fibres are to fill when grown is the sum of both,
/// or, where no fibre id is in use and both say the same, what each says: these are pieces of one substrate, and it returns true.
/// Throws InvalidInput if there is no id free.
bool appendFibres(const Fibres& added, Fibres& all);

/// Joins fibres into one substrate, in their order. Throws InvalidInput if the domains differ, or as appendFibres() does.
Fibres joinFibres(std::vector<Fibres> inputs);

/// Tells whether two domains are equal to 1e-9 µm.
bool isSame(const Domain& a, const Domain& b);

} // namespace cactus
