// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBundleInitializer.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "bundle/BundleInitializer.h"
#include "stages/StageWork.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkBundleInitializer);

vtkBundleInitializer::vtkBundleInitializer()
  : Properties(cactus::makeProperties<cactus::BundleInitializerStage>())
{
  this->SetNumberOfInputPorts(0);
}

int vtkBundleInitializer::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time)
{
  return cactus::pipelineTime(this, time);
}

int vtkBundleInitializer::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::BundleInitializerStage>(this->Properties);
      cactus::validateProperties(stage);
      const cactus::BundleInitializerOptions options = cactus::bundleOptions(stage);

      cactus::BundleInitializerReport report;
      const cactus::Fibres fibres = cactus::initialiseBundles(options, cactus::contextFor(this), &report);
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(fibres, output);
      const cactus::StageRecord record = cactus::bundleRecord(stage, options, fibres.size(), report);
      cactus::setProvenance(output, cactus::provenanceOf(record), 0);
      const std::string remarks = cactus::remarksOnBundle(options, report);
      if (!remarks.empty())
      {
        vtkWarningMacro(<< remarks);
      }
    });
}

void vtkBundleInitializer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties->print(os, indent);
}
