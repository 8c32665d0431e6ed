// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "judge/CertificateFindings.h"
#include "mesh/FibreSurfaces.h"

namespace cactus
{

/// Computes counts, sums and extremes over the fibres of a certificate, in their order, and the surfaces' fractions of the
/// domain. Surfaces reach out of it by up to `reach` (µm). The gaps have to be known.
void summarise(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, double minimumGap, double reach,
  SubstrateCertificate& certificate);

/// Lists the faults of a certificate whose summary is known.
void listFaults(SubstrateCertificate& certificate);

} // namespace cactus
