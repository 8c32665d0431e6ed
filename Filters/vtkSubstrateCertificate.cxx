// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubstrateCertificate.h"

#include "Columns.h"
#include "DataProvenance.h"
#include "FilterSupport.h"
#include "RankTeam.h"
#include "StageProperties.h"
#include "SubstrateInputs.h"
#include "WholeData.h"
#include "base/Numbers.h"
#include "base/Sharing.h"
#include "judge/CertificateTables.h"
#include "judge/SubstrateCertificate.h"
#include "stages/Stages.h"

#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

vtkStandardNewMacro(vtkSubstrateCertificate);

namespace
{

void fill(vtkTable* table, const std::vector<cactus::CertificateColumn>& columns)
{
  for (const auto& column : columns)
  {
    const auto value = [&](std::size_t row) { return column.values[row]; };
    if (column.whole)
    {
      cactus::addColumn<vtkIdTypeArray>(table, column.name, column.values.size(), value);
    }
    else
    {
      cactus::addColumn<vtkDoubleArray>(table, column.name, column.values.size(), value);
    }
  }
}

/// Fills a table with a row per line: ParaView's spreadsheets sort columns by name, but not rows.
void fill(vtkTable* table, const std::vector<cactus::CertificateLine>& lines)
{
  cactus::addColumn<vtkStringArray>(table, "Finding", lines.size(), [&](std::size_t row) { return lines[row].finding; });
  cactus::addColumn<vtkStringArray>(table, "Value", lines.size(), [&](std::size_t row) { return lines[row].value; });
}

} // namespace

vtkSubstrateCertificate::vtkSubstrateCertificate()
  : Properties(cactus::makeProperties<cactus::SubstrateCertificateStage>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(3);
}

int vtkSubstrateCertificate::FillInputPortInformation(int port, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port > 0 ? 1 : 0);
  return 1;
}

int vtkSubstrateCertificate::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 3);
  return 1;
}

int vtkSubstrateCertificate::RequestData(vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  cactus::RankTeam ranks;
  const cactus::Sharing all(&ranks);
  const bool isAsked = cactus::ownsWholeOutput(request, outputs);
  return cactus::guarded(this, all, [&] { all.together([&] { this->judge(all, isAsked, outputs); }); });
}

void vtkSubstrateCertificate::judge(const cactus::Sharing& all, bool isAsked, vtkInformationVector* outputs)
{
  const auto& stage = cactus::stageOf<cactus::SubstrateCertificateStage>(this->Properties);
  cactus::validateProperties(stage);
  const cactus::SubstrateData data = cactus::substrateDataOf(this, 0, 1, 2);
  const cactus::Sharing sharing = cactus::sharingOf(data, cactus::valuesForResult(stage), all);
  if (sharing.size() == 1 && !isAsked)
  {
    return;
  }
  const cactus::Substrate substrate = cactus::substrateFrom(data);
  const auto certificate = cactus::certify(substrate.domain, substrate.outer, substrate.inner, substrate.fibresOrNull(),
    stage.options, cactus::contextFor(this, stage.threads), sharing);
  if (!isAsked)
  {
    return; // the tables of all ranks would be joined into rows that repeat
  }
  if (!certificate.certified() && all.isFirst())
  {
    vtkWarningMacro(<< "the substrate is not certified: " << certificate.verdict());
  }
  else if (!certificate.remarks.empty() && all.isFirst())
  {
    vtkWarningMacro(<< certificate.remarks.front());
  }
  fill(vtkTable::GetData(outputs, 0), cactus::substrateColumns(certificate));
  fill(vtkTable::GetData(outputs, 1), cactus::fibreColumns(certificate));
  fill(vtkTable::GetData(outputs, 2), cactus::certificateLines(certificate));
  const auto provenance = cactus::recordOf(this, "SubstrateCertificate", stage, { "Outer", "Inner", "Fibres" });
  for (int port = 0; port < 3; ++port)
  {
    cactus::setProvenance(vtkTable::GetData(outputs, port), provenance, port);
  }
}
