// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "judge/CertificateFindings.h"

#include <string>
#include <vector>

namespace cactus
{

/// A column of a certificate's tables.
struct CertificateColumn
{
  std::string name;   ///< with its unit, if it has one
  bool whole = false; ///< whole numbers: counts, ids, and 0 or 1
  std::vector<double> values;
};

/// The certificate as a table of one row, the verdict `Certified` (0 or 1) first.
std::vector<CertificateColumn> substrateColumns(const SubstrateCertificate& certificate);

/// A row for each fibre.
std::vector<CertificateColumn> fibreColumns(const SubstrateCertificate& certificate);

} // namespace cactus
