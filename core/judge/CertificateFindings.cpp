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

std::string SubstrateCertificate::scope() const
{
  if (this->outerJudged == this->innerJudged)
  {
    return "";
  }
  return this->outerJudged ? "for its outer surfaces alone, as there are no inner ones"
                           : "for its inner surfaces alone, as there are no outer ones";
}

} // namespace cactus
