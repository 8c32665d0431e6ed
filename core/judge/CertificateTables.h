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

/// One thing that the certificate says, to be read.
struct CertificateLine
{
  std::string finding; ///< what it is about: "Verdict", else a column of the substrate's table
  std::string value;
};

/// The certificate to be read line by line: the verdict in words with what it is of, then the columns of the substrate's table.
/// Numbers have six digits; what was not measured is "-".
std::vector<CertificateLine> certificateLines(const SubstrateCertificate& certificate);

} // namespace cactus
