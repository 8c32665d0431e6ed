// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "judge/CertificateFindings.h"
#include "judge/FibreExamination.h"

#include <memory>
#include <vector>

namespace cactus
{

/// Measures how near the outer surfaces of fibres come to each other, which of them meet and which lie inside one another, for
/// each fibre and the whole certificate. `outer` are the fibres' surfaces, in the certificate's order of fibres, or null. Pairs
/// of fibres are sorted out by their boxes. Progress runs from `from` to 1. Throws Cancelled.
void findGaps(const std::vector<std::unique_ptr<TreedSurface>>& outer, SubstrateCertificate& certificate, const Context& context,
  double from);

} // namespace cactus
