// SPDX-License-Identifier: BSD-3-Clause
#include "io/CertificateText.h"

#include "judge/CertificateTables.h"

#include <charconv>
#include <cmath>

namespace cactus
{

namespace
{

/// Returns a certificate's value; empty if it is not a number.
std::string cell(const CertificateColumn& column, std::size_t row)
{
  const double value = column.values[row];
  if (!std::isfinite(value))
  {
    return "";
  }
  char text[32];
  return column.whole ? std::to_string(static_cast<long long>(value))
                      : std::string(text, std::to_chars(text, text + sizeof(text), value).ptr);
}

} // namespace

std::string certificateText(const SubstrateCertificate& certificate)
{
  std::string text = "quantity,value\n";
  for (const CertificateColumn& column : substrateColumns(certificate))
  {
    text += column.name + "," + cell(column, 0) + "\n";
  }
  return text;
}

std::string fibresText(const SubstrateCertificate& certificate)
{
  const auto columns = fibreColumns(certificate);
  std::string text;
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    text += (c > 0 ? "," : "") + columns[c].name;
  }
  for (std::size_t row = 0; row < certificate.fibres.size(); ++row)
  {
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      text += (c > 0 ? "," : "\n") + cell(columns[c], row);
    }
  }
  return text + "\n";
}

} // namespace cactus
