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

/// Returns the certificate as a table of one row, the verdict `Certified` (0 or 1) first.
std::vector<CertificateColumn> substrateColumns(const SubstrateCertificate& certificate);

/// Returns a table with a row for each fibre.
std::vector<CertificateColumn> fibreColumns(const SubstrateCertificate& certificate);

/// One statement of the certificate, as text.
struct CertificateLine
{
  std::string finding; ///< its subject: "Verdict", else a column of the substrate's table
  std::string value;
};

/// Returns the certificate as lines of text: the verdict in words with its scope, then the columns of the substrate's table.
/// Numbers have six digits; unmeasured values are "-".
std::vector<CertificateLine> certificateLines(const SubstrateCertificate& certificate);

} // namespace cactus
