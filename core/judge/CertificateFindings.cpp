// SPDX-License-Identifier: BSD-3-Clause
#include "judge/CertificateFindings.h"

namespace cactus
{

std::string SubstrateCertificate::verdict() const
{
  std::string text = this->faults.empty() ? "certified" : "";
  for (const std::string& fault : this->faults)
  {
    text += (text.empty() ? "" : "; ") + fault;
  }
  return text;
}

} // namespace cactus
