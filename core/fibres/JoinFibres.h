// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

namespace cactus
{

/// Adds fibres to others of one substrate. If one of their fibre ids is in use, all of these are moved above the largest one in
/// use; and so are bundle ids. The domain of `added` does not count. Throws InvalidInput if there is no id free.
void appendFibres(const Fibres& added, Fibres& all);

/// Whether two domains are the same to 1e-9 µm.
bool isSame(const Domain& a, const Domain& b);

} // namespace cactus
