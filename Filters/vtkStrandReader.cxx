// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStrandReader.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "base/Error.h"
#include "io/StrandFile.h"
#include "stages/Stages.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkStrandReader);

vtkStrandReader::vtkStrandReader()
  : Properties(cactus::makeProperties<cactus::StrandReaderStage>())
{
  this->SetNumberOfInputPorts(0);
}

int vtkStrandReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::StrandReaderStage>(this->Properties);
      if (stage.fileName.empty())
      {
        throw cactus::InvalidInput("FileName is empty: name the strand file to read");
      }
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(cactus::readStrandFile(stage.fileName), output);
      cactus::StageRecord record;
      record.filter = "StrandReader";
      record.properties = cactus::StrandReaderStage::properties().states(stage);
      record.files.push_back({ "FileName", stage.fileName });
      cactus::setProvenance(output, cactus::provenanceOf(record), 0);
    });
}

void vtkStrandReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties->print(os, indent);
}
