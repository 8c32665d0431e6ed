// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubstrateProduction.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "OverlapRemark.h"
#include "StageProperties.h"
#include "SubstrateFileTable.h"
#include "SurfaceTable.h"
#include "WholeData.h"
#include "growth/TargetRadii.h"
#include "stages/StageWork.h"

#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkTable.h>

#include <string>

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

int vtkSubstrateProduction::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time)
{
  return cactus::pipelineTime(this, time);
}

int vtkSubstrateProduction::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::SubstrateProductionStage>(this->Properties);
      cactus::validateProperties(stage);
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        return;
      }
      auto* input = vtkDataObject::GetData(inputs[0]);
      const cactus::Fibres fibres = cactus::fibresFrom(input);
      const cactus::Context context = cactus::contextFor(this, stage.threads);
      cactus::Provenance records;
      const cactus::ProductionOrder order = cactus::productionOrder(stage,
        [&](double spacing, double growth)
        {
          records =
            cactus::recordOf(this, "SubstrateProduction", stage, { "Input" }, { { "Spacing", spacing }, { "Growth", growth } });
          return records;
        });
      for (const std::string& remark :
        { cactus::remarkOnOverlaps(input, fibres, context.threadCount()), cactus::remarkOnTarget(fibres, order.growth) })
      {
        if (!remark.empty())
        {
          vtkWarningMacro(<< remark);
        }
      }
      const auto produced = cactus::produceSubstrate(fibres, order, stage.folderName, context);
      const cactus::WrittenSubstrate& written = produced.written;
      std::string remarks = produced.remarks;
      if (!written.certificate.certified())
      {
        remarks += (remarks.empty() ? "" : ". So ") + ("the substrate in " + stage.folderName + " is not certified: ") +
                   written.certificate.verdict();
      }
      if (!remarks.empty())
      {
        vtkWarningMacro(<< remarks);
      }
      for (const std::string& sentence : written.allRemarks())
      {
        vtkWarningMacro(<< sentence);
      }
      cactus::fillFileTable(vtkTable::GetData(outputs, 0), written.files);
      cactus::fillSurfaceTable(vtkTable::GetData(outputs, 1), produced.fibres);
      for (int port = 0; port < 2; ++port)
      {
        cactus::setDomain(vtkDataObject::GetData(outputs, port), fibres.domain);
        cactus::setProvenance(vtkDataObject::GetData(outputs, port), records, port);
      }
    });
}

void vtkSubstrateProduction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties->print(os, indent);
}
