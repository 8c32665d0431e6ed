// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "judge/CertificateFindings.h"
#include "mesh/FibreSurfaces.h"

namespace cactus
{

/// Counts, sums and extremes over the fibres of a certificate, in their order, and what the surfaces fill of the domain. Surfaces
/// reach out of that by up to `reach` (µm). The gaps have to be known.
void summarise(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, double minimumGap, double reach,
  SubstrateCertificate& certificate);

/// Says what keeps a certificate, whose summary is known, from being one.
void listFaults(SubstrateCertificate& certificate);

} // namespace cactus
