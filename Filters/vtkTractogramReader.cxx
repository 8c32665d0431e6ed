// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTractogramReader.h"

#include "DataProvenance.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "TractogramData.h"
#include "io/TractogramFile.h"
#include "stages/StageWork.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <utility>

vtkStandardNewMacro(vtkTractogramReader);

vtkTractogramReader::vtkTractogramReader()
  : Properties(cactus::makeProperties<cactus::TractogramReaderStage>())
{
  this->SetNumberOfInputPorts(0);
}

int vtkTractogramReader::CanReadFile(const char* name)
{
  return name != nullptr && cactus::isTractogram(name) ? 1 : 0;
}

int vtkTractogramReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::TractogramReaderStage>(this->Properties);
      cactus::validateProperties(stage);
      cactus::Tractogram tractogram = cactus::tractogramOf(stage, cactus::contextFor(this));
      for (const std::string& remark : tractogram.remarks)
      {
        vtkWarningMacro(<< stage.fileName << ": " << remark);
      }
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(std::move(tractogram), output);
      cactus::setProvenance(output, cactus::provenanceOf(cactus::tractogramRecord(stage)), 0);
    });
}
