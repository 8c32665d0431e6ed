// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubstrateWriter.h"

#include "DataProvenance.h"
#include "FilterSupport.h"
#include "InputBlocks.h"
#include "PlacementData.h"
#include "RankTeam.h"
#include "StageProperties.h"
#include "SubstrateFileTable.h"
#include "SubstrateInputs.h"
#include "WholeData.h"
#include "base/Numbers.h"
#include "base/Sharing.h"
#include "io/SubstrateFolder.h"
#include "io/SubstrateReading.h"
#include "stages/StageWork.h"

#include <vtkDataObject.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkTable.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkSubstrateWriter);

namespace
{

/// Returns the folder that is meant by a name chosen in a dialog, which walks into a folder that is there already and adds its
/// name once more: that folder, if it is a substrate folder.
std::string chosenFolder(const std::string& name)
{
  const std::filesystem::path path(name);
  const std::filesystem::path parent = path.parent_path();
  return path.has_filename() && path.filename() == parent.filename() && cactus::isSubstrate(parent.string()) ? parent.string()
                                                                                                             : name;
}

/// Returns when any input, connected or not, was last changed.
vtkMTimeType newestInput(vtkSubstrateWriter* self)
{
  const cactus::SubstrateData data = cactus::substrateDataOf(self, 0, 1, 2);
  vtkMTimeType newest = 0;
  for (vtkDataObject* one : { data.outer, data.inner, data.fibres })
  {
    newest = std::max(newest, one != nullptr ? cactus::changeTime(one) : 0);
  }
  return newest;
}

} // namespace

vtkSubstrateWriter::vtkSubstrateWriter()
  : Properties(cactus::makeProperties<cactus::SubstrateWriterStage>())
{
  this->SetNumberOfInputPorts(3);
}

int vtkSubstrateWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port > 0 ? 1 : 0);
  return 1;
}

int vtkSubstrateWriter::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 3);
  return 1;
}

int vtkSubstrateWriter::RequestData(vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  cactus::RankTeam ranks;
  const cactus::Sharing all(&ranks);
  cactus::attempt(this, all,
    [&]
    {
      if (!all.isEverywhere(this->Kept.isWritten(this)))
      {
        all.together([&] { this->WriteFolder(all); });
        this->Kept.noteWritten(this, newestInput(this));
      }
      const std::string remark = this->Kept.remark(this->GetFolderName(), newestInput(this));
      if (!remark.empty() && all.isFirst())
      {
        vtkWarningMacro(<< remark);
      }
      if (cactus::ownsWholeOutput(request, outputs))
      {
        vtkTable::GetData(outputs)->ShallowCopy(this->WrittenFiles);
      }
    });
  return 1;
}

void vtkSubstrateWriter::WriteFolder(const cactus::Sharing& all)
{
  const auto& stage = cactus::stageOf<cactus::SubstrateWriterStage>(this->Properties);
  cactus::validateProperties(stage);
  const cactus::SubstrateData data = cactus::substrateDataOf(this, 0, 1, 2);
  const cactus::Sharing sharing = cactus::sharingOf(data, stage.folderName + '\n' + cactus::valuesForResult(stage), all);
  if (sharing.size() == 1 && !all.isFirst())
  {
    return;
  }
  cactus::Substrate substrate = cactus::wholeSubstrateFrom(data);
  cactus::SubstrateFolderContents contents;
  contents.placement = cactus::placementOf(data.outer);
  contents.outer = std::move(substrate.outer);
  contents.inner = std::move(substrate.inner);
  contents.domain = substrate.domain;
  contents.fibres = substrate.fibresOrNull();
  contents.provenance = cactus::recordOf(this, "SubstrateWriter", stage, { "Outer", "Inner", "Fibres" });
  cactus::setWriterOptions(stage, contents);
  const auto written = cactus::writeSubstrateFolder(contents, stage.folderName, cactus::contextFor(this, stage.threads), sharing);
  if (!written.certificate.certified() && all.isFirst())
  {
    vtkWarningMacro(<< "the substrate in " << stage.folderName << " is not certified: " << written.certificate.verdict());
  }
  for (const std::string& sentence : all.isFirst() ? written.remarks : std::vector<std::string>())
  {
    vtkWarningMacro(<< sentence);
  }
  this->WrittenFiles->Initialize();
  cactus::fillFileTable(this->WrittenFiles, written.files);
  cactus::setProvenance(this->WrittenFiles, contents.provenance, 0);
}

int vtkSubstrateWriter::Write()
{
  this->SetFolderName(chosenFolder(this->GetFolderName()).c_str());
  const bool isWritten = cactus::writeNow(this);
  this->ErrorCode = isWritten ? vtkErrorCode::NoError : vtkErrorCode::CannotOpenFileError; // SetErrorCode() would count as a
                                                                                           // change
  return isWritten ? 1 : 0;
}
