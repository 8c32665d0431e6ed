// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "judge/CertificateFindings.h"

#include <string>

namespace cactus
{

/// Returns a certificate as CSV, one line for each quantity, since one long row is hard to read. A value that is not a number is
/// left out; the others are the shortest text that reads back as the same number.
std::string certificateText(const SubstrateCertificate& certificate);

/// Returns the findings on the fibres as CSV, with a row for each.
std::string fibresText(const SubstrateCertificate& certificate);

} // namespace cactus
