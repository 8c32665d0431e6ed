// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStrandReader.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "io/FibreFile.h"
#include "stages/StageWork.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <string>

vtkStandardNewMacro(vtkStrandReader);

vtkStrandReader::vtkStrandReader()
  : Properties(cactus::makeProperties<cactus::StrandReaderStage>())
{
  this->SetNumberOfInputPorts(0);
}

int vtkStrandReader::CanReadFile(const char* name)
{
  return name != nullptr && cactus::isFibreFile(name) ? 1 : 0;
}

int vtkStrandReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::StrandReaderStage>(this->Properties);
      cactus::validateProperties(stage);
      const cactus::FibresOfFile read = cactus::strandsOf(stage);
      for (const std::string& remark : read.remarks)
      {
        vtkWarningMacro(<< stage.fileName << ": " << remark);
      }
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(read.fibres, output);
      cactus::setProvenance(output, cactus::provenanceOf(cactus::strandRecord(stage)), 0);
    });
}
