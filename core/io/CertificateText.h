// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "judge/CertificateFindings.h"

#include <string>

namespace cactus
{

/// A certificate as CSV, one line for each quantity, which is how a person reads a single row. A value that is not a number is
/// left out; the others are the shortest text that reads back as the same number.
std::string certificateText(const SubstrateCertificate& certificate);

/// What it says of each fibre, as CSV with a row for each.
std::string fibresText(const SubstrateCertificate& certificate);

} // namespace cactus
