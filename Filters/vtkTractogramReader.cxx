// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTractogramReader.h"

#include "DataProvenance.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "TractogramData.h"
#include "base/Error.h"
#include "io/FileCollection.h"
#include "io/TractogramFile.h"
#include "stages/Stages.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <filesystem>

vtkStandardNewMacro(vtkTractogramReader);

namespace
{

/// The file, or all files of a folder.
std::vector<cactus::FileRead> filesRead(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::is_directory(path, error))
  {
    return { { "FileName", path } };
  }
  std::vector<cactus::FileRead> files;
  for (const std::string& name : cactus::Folder(path).names())
  {
    files.push_back({ "FileName", (std::filesystem::path(path) / name).string() });
  }
  return files;
}

} // namespace

vtkTractogramReader::vtkTractogramReader()
  : Properties(cactus::makeProperties<cactus::TractogramReaderStage>())
{
  this->SetNumberOfInputPorts(0);
}

int vtkTractogramReader::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time)
{
  return cactus::pipelineTime(this, time);
}

int vtkTractogramReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::TractogramReaderStage>(this->Properties);
      cactus::validateProperties(stage);
      if (stage.fileName.empty())
      {
        throw cactus::InvalidInput("FileName is empty: name the tractogram to read");
      }
      cactus::Tractogram tractogram = cactus::readTractogram(stage.fileName, cactus::contextFor(this));
      for (const std::string& remark : tractogram.remarks)
      {
        vtkWarningMacro(<< stage.fileName << ": " << remark);
      }
      cactus::StageRecord record;
      record.filter = "TractogramReader";
      record.properties = cactus::TractogramReaderStage::properties().states(stage);
      record.files = filesRead(stage.fileName);
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(std::move(tractogram), stage.lengthUnit, stage.radius, output);
      cactus::setProvenance(output, cactus::provenanceOf(record), 0);
    });
}

void vtkTractogramReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties->print(os, indent);
}
