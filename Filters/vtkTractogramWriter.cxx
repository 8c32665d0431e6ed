// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTractogramWriter.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "PlacementData.h"
#include "Ranks.h"
#include "StageProperties.h"
#include "WholeData.h"
#include "base/Error.h"
#include "base/Placement.h"
#include "io/TractogramFile.h"
#include "stages/Stages.h"
#include "stages/TractRecords.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>

#include <optional>

vtkStandardNewMacro(vtkTractogramWriter);

vtkTractogramWriter::vtkTractogramWriter()
  : Properties(cactus::makeProperties<cactus::TractogramWriterStage>())
{
}

int vtkTractogramWriter::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

void vtkTractogramWriter::WriteData()
{
  // On several ranks each gets all fibres, since a sink requests the only piece; the first writes them.
  if (!cactus::isFirstProcess())
  {
    return;
  }
  const bool isWritten = cactus::attempt(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::TractogramWriterStage>(this->Properties);
      cactus::validateProperties(stage);
      if (stage.fileName.empty())
      {
        throw cactus::InvalidInput("FileName is empty: name the tractogram to write");
      }
      const auto placement = cactus::placementOf(this->GetInput());
      cactus::requireFileUnit(stage.lengthUnit, placement.has_value());
      const bool isInMillimetres = cactus::areStreamlinesInMillimetres(cactus::originsOf(this, { "Input" }));
      const cactus::Placement inScanner; // µm in place of mm
      const cactus::Fibres tract =
        cactus::tractFrom(this->GetInput(), isInMillimetres ? std::make_optional(inScanner) : std::nullopt);
      cactus::writeTractogram(tract, placement.value_or(inScanner), stage.fileName, stage.lengthUnit);
      if (stage.lengthUnit == cactus::LengthUnit::Micrometre)
      {
        vtkWarningMacro(<< stage.fileName << cactus::micrometresInFile);
      }
    });
  if (!isWritten)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
  }
}
