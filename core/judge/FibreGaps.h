// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Domain.h"
#include "base/Recollection.h"
#include "base/Sharing.h"
#include "judge/CertificateFindings.h"
#include "judge/OuterSurfaces.h"

namespace cactus
{

/// Measures the gaps between the outer surfaces of fibres, which of them meet and which lie inside one another, for each fibre
/// and the whole certificate; `outer` has the surfaces by the indices of its fibres. In a periodic domain fibres also have gaps
/// to the images of others. A tree over the boxes of the surfaces' parts finds the relevant pairs: O(n log n) for n fibres with
/// about equally many neighbours. Progress runs from `from` to 1. Throws Cancelled. Processes share the work, and all get the
/// result. Gaps in the cache `known` are not measured again.
void findGaps(const Domain& domain, const OuterSurfaces& outer, SubstrateCertificate& certificate, const Context& context,
  double from, const Sharing& sharing = Sharing(), const Recollection& known = {});

} // namespace cactus
