// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStrandWriter.h"

#include "FibreData.h"
#include "FilterSupport.h"
#include "Ranks.h"
#include "StageProperties.h"
#include "WholeData.h"
#include "base/Error.h"
#include "io/StrandFile.h"
#include "stages/Stages.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkStrandWriter);

vtkStrandWriter::vtkStrandWriter()
  : Properties(cactus::makeProperties<cactus::StrandWriterStage>())
{
}

int vtkStrandWriter::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

void vtkStrandWriter::WriteData()
{
  // On several ranks each gets all fibres, since a sink requests the only piece; the first writes them.
  if (!cactus::isFirstProcess())
  {
    return;
  }
  const bool isWritten = cactus::attempt(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::StrandWriterStage>(this->Properties);
      cactus::validateProperties(stage);
      if (stage.fileName.empty())
      {
        throw cactus::InvalidInput("FileName is empty: name the strand file to write");
      }
      cactus::writeStrandFile(cactus::fibresFrom(this->GetInput()), stage.fileName);
    });
  if (!isWritten)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
  }
}
