// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTractFibres.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "StreamlineData.h"
#include "WholeData.h"
#include "bundle/TractFibres.h"
#include "stages/StageWork.h"
#include "stages/TractRecords.h"

#include <vtkInformation.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <string>

vtkStandardNewMacro(vtkTractFibres);

vtkTractFibres::vtkTractFibres()
  : Properties(cactus::makeProperties<cactus::TractFibresStage>())
{
}

int vtkTractFibres::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

int vtkTractFibres::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 1);
  return 1;
}

int vtkTractFibres::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& given = cactus::stageOf<cactus::TractFibresStage>(this->Properties);
      cactus::validateProperties(given);
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        return;
      }
      const cactus::InputOrigins origins = cactus::originsOf(this, { "Input" });
      const cactus::TractFibresStage stage = cactus::askedOfTract(given, origins);
      const cactus::TractFibresOptions options = cactus::tractOptions(stage);
      const cactus::Streamlines streamlines = cactus::streamlinesFrom(vtkDataObject::GetData(inputs[0]));

      cactus::TractFibresReport report;
      const cactus::Fibres fibres = cactus::layTractFibres(streamlines, options, cactus::contextFor(this), &report);
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(fibres, output);
      cactus::StageRecord record = cactus::tractRecord(stage, options, fibres.size(), report);
      record.inputs = origins;
      cactus::setProvenance(output, cactus::provenanceOf(record), 0);
      const std::string remarks = cactus::remarksOnTract(report);
      if (!remarks.empty())
      {
        vtkWarningMacro(<< remarks);
      }
    });
}
