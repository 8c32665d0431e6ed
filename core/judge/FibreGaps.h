// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Recollection.h"
#include "base/Sharing.h"
#include "judge/CertificateFindings.h"
#include "judge/OuterSurfaces.h"

namespace cactus
{

/// Measures how near the outer surfaces of fibres come to each other, which of them meet and which lie inside one another, for
/// each fibre and the whole certificate, whose fibres' `outer` surfaces are by their places in it. A tree over the boxes of the
/// surfaces' parts tells which fibres can matter to each other: O(n log n) for n fibres that have about equally many neighbours.
/// Progress runs from `from` to 1. Throws Cancelled. Processes share it, and all get the result. What is `known` of fibres' gaps
/// is not measured again.
void findGaps(const OuterSurfaces& outer, SubstrateCertificate& certificate, const Context& context, double from,
  const Sharing& sharing = Sharing(), const Recollection& known = {});

} // namespace cactus
