// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubstrateProduction.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "InputBlocks.h"
#include "OverlapRemark.h"
#include "RankTeam.h"
#include "StageProperties.h"
#include "SubstrateFileTable.h"
#include "SurfaceTable.h"
#include "WholeData.h"
#include "base/Sharing.h"
#include "growth/TargetRadii.h"
#include "stages/StageWork.h"

#include <vtkDataObject.h>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkTable.h>

#include <algorithm>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSubstrateProduction);

vtkSubstrateProduction::vtkSubstrateProduction()
  : Properties(cactus::makeProperties<cactus::SubstrateProductionStage>())
{
  this->SetNumberOfOutputPorts(2);
}

int vtkSubstrateProduction::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

int vtkSubstrateProduction::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 1);
  return 1;
}

int vtkSubstrateProduction::RequestData(vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  cactus::RankTeam ranks;
  const cactus::Sharing sharing(&ranks);
  cactus::attempt(this, sharing,
    [&]
    {
      if (!sharing.isEverywhere(this->Kept.isWritten(this)))
      {
        sharing.together([this] { this->Produce(); });
        this->Kept.noteWritten(this, cactus::changeTime(this->GetInputDataObject(0, 0)));
      }
      const std::string remark = this->Kept.remark(this->GetFolderName(), cactus::changeTime(this->GetInputDataObject(0, 0)));
      if (!remark.empty() && sharing.isFirst())
      {
        vtkWarningMacro(<< remark);
      }
      if (cactus::ownsWholeOutput(request, outputs))
      {
        vtkTable::GetData(outputs, 0)->ShallowCopy(this->Files);
        vtkTable::GetData(outputs, 1)->ShallowCopy(this->Fibres);
      }
    });
  return 1;
}

void vtkSubstrateProduction::Produce()
{
  const auto& stage = cactus::stageOf<cactus::SubstrateProductionStage>(this->Properties);
  cactus::validateProperties(stage);
  cactus::RankTeam ranks;
  vtkDataObject* input = this->GetInputDataObject(0, 0);
  const cactus::Fibres fibres = cactus::fibresFrom(input);
  const cactus::Context context = cactus::contextFor(this, stage.threads);
  cactus::Provenance records;
  const cactus::ProductionOrder order = cactus::productionOrder(stage,
    [&](double spacing, const cactus::SolvedGrowth& growth)
    {
      records = cactus::recordOf(this, "SubstrateProduction", stage, { "Input" }, cactus::growthReached(spacing, growth));
      return records;
    });
  const auto say = [&](const std::string& remark)
  {
    if (!remark.empty() && ranks.place() == 0)
    {
      vtkWarningMacro(<< remark);
    }
  };
  if (ranks.place() == 0)
  {
    say(cactus::remarkOnOverlaps(input, fibres, context.threadCount()));
    say(cactus::remarkOnTarget(fibres, order.growth));
  }
  const auto produced = cactus::produceSubstrate(fibres, order, stage.folderName, context, &ranks);
  const cactus::WrittenSubstrate& written = produced.written;
  std::string remarks = produced.remarks;
  if (!written.certificate.certified())
  {
    remarks += (remarks.empty() ? "" : ". So ") + ("the substrate in " + stage.folderName + " is not certified: ") +
               written.certificate.verdict();
  }
  say(remarks);
  const std::vector<std::string> sentences = written.remarks;
  std::for_each(sentences.begin(), sentences.end(), say);
  this->Files->Initialize();
  this->Fibres->Initialize();
  cactus::fillFileTable(this->Files, written.files);
  cactus::fillSurfaceTable(this->Fibres, produced.fibres);
  int port = 0;
  for (vtkTable* table : { this->Files.Get(), this->Fibres.Get() })
  {
    cactus::setDomain(table, fibres.domain);
    cactus::setProvenance(table, records, port++);
  }
}

int vtkSubstrateProduction::Write()
{
  const bool isWritten = cactus::writeNow(this);
  this->ErrorCode = isWritten ? vtkErrorCode::NoError : vtkErrorCode::CannotOpenFileError; // SetErrorCode() would count as a
                                                                                           // change
  return isWritten ? 1 : 0;
}
