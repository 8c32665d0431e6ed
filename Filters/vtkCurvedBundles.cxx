// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCurvedBundles.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "bundle/CurvedBundles.h"
#include "stages/StageWork.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkCurvedBundles);

vtkCurvedBundles::vtkCurvedBundles()
  : Properties(cactus::makeProperties<cactus::CurvedBundlesStage>())
{
  this->SetNumberOfInputPorts(0);
}

int vtkCurvedBundles::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::CurvedBundlesStage>(this->Properties);
      cactus::validateProperties(stage);
      const cactus::CurvedBundlesOptions options = cactus::curvedOptions(stage);

      double filled = 0.0;
      const cactus::Fibres fibres = cactus::layCurvedBundles(options, cactus::contextFor(this), &filled);
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(fibres, output);
      cactus::setProvenance(output, cactus::provenanceOf(cactus::curvedRecord(stage, options, fibres.size(), filled)), 0);
    });
}
