// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNiftiWriter.h"

#include "FilterSupport.h"
#include "PlacementData.h"
#include "Ranks.h"
#include "StageProperties.h"
#include "WholeData.h"
#include "base/AtomicFile.h"
#include "base/Error.h"
#include "stages/Stages.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include <unistd.h>

vtkStandardNewMacro(vtkNiftiWriter);

namespace
{

namespace fs = std::filesystem;

/// A temporary folder of this process that is removed with its content.
class ScratchFolder
{
public:
  ScratchFolder()
  {
    std::string name = (fs::temp_directory_path() / "cactus-nifti-").string() + std::string(6, 'X'); // filled in by mkdtemp
    if (::mkdtemp(name.data()) == nullptr)
    {
      throw cactus::FileError("cannot make a folder in " + fs::temp_directory_path().string());
    }
    this->Path = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder()
  {
    std::error_code error;
    fs::remove_all(this->Path, error);
  }
  fs::path file(const std::string& name) const { return this->Path / name; }

private:
  fs::path Path;
};

vtkImageData* imageOf(vtkDataObject* input)
{
  auto* image = vtkImageData::SafeDownCast(input);
  if (image == nullptr || image->GetNumberOfPoints() == 0)
  {
    throw cactus::InvalidInput("the input is no image, or an empty one: connect SubstrateSampler or FibreRadialGrowth");
  }
  return image;
}

/// Returns the image with only the array to be written.
vtkSmartPointer<vtkImageData> withArray(vtkImageData* image, const std::string& name)
{
  vtkPointData* data = image->GetPointData();
  vtkDataArray* array = name.empty() ? data->GetScalars() : data->GetArray(name.c_str());
  if (array == nullptr)
  {
    throw cactus::InvalidInput(name.empty() ? "the input has no active scalars: name an Array"
                                            : "the input has no point data called " + name + " (Array)");
  }
  auto alone = vtkSmartPointer<vtkImageData>::New();
  alone->CopyStructure(image);
  alone->GetPointData()->SetScalars(array);
  return alone;
}

/// Writes by VTK's own writer, which knows the format by the name.
void write(vtkImageData* image, cactus::LengthUnit unit, const std::string& path)
{
  // The writer ignores an image's direction matrix.
  vtkNew<vtkMatrix4x4> grid;
  double first[3];
  const int* extent = image->GetExtent();
  image->TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], first);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      grid->SetElement(row, column, image->GetDirectionMatrix()->GetElement(row, column));
    }
    grid->SetElement(row, 3, first[row]);
  }
  vtkNew<vtkImageData> atOrigin;
  atOrigin->ShallowCopy(image);
  atOrigin->SetOrigin(0.0, 0.0, 0.0);
  atOrigin->SetExtent(0, extent[1] - extent[0], 0, extent[3] - extent[2], 0, extent[5] - extent[4]);
  vtkNew<vtkNIFTIImageHeader> header;
  header->SetXYZTUnits(unit == cactus::LengthUnit::Millimetre ? vtkNIFTIImageHeader::UnitsMM : vtkNIFTIImageHeader::UnitsMicron);
  vtkNew<vtkNIFTIImageWriter> writer;
  writer->SetInputData(atOrigin);
  writer->SetNIFTIHeader(header);
  writer->SetQFormMatrix(grid);
  writer->SetSFormMatrix(grid);
  // A direction is a vector, along the fifth dimension; more numbers are volumes, along the fourth, as MRtrix requires.
  const int components = image->GetPointData()->GetScalars()->GetNumberOfComponents();
  writer->SetTimeDimension(components > 3 ? components : 0);
  writer->SetFileName(path.c_str());
  writer->Write();
  if (writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw cactus::FileError("cannot write " + path + ": " + vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  }
}

/// Copies a finished file to its place, whole or not at all.
void place(const fs::path& from, const std::string& to)
{
  cactus::AtomicFile file(to);
  std::ifstream content(from, std::ios::binary);
  std::vector<char> block(1 << 20);
  while (content)
  {
    content.read(block.data(), static_cast<std::streamsize>(block.size()));
    file.stream().write(block.data(), content.gcount());
  }
  if (!content.eof())
  {
    throw cactus::FileError("cannot write " + to + ": " + from.string() + ", where it was made, cannot be read back");
  }
  file.commit();
}

} // namespace

vtkNiftiWriter::vtkNiftiWriter()
  : Properties(cactus::makeProperties<cactus::NiftiWriterStage>())
{
}

int vtkNiftiWriter::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

void vtkNiftiWriter::WriteData()
{
  // On several ranks the first one writes, since a sink requests the only piece.
  if (!cactus::isFirstProcess())
  {
    return;
  }
  const bool isWritten = cactus::attempt(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::NiftiWriterStage>(this->Properties);
      cactus::validateProperties(stage);
      const fs::path path = stage.fileName;
      const bool isPacked = path.extension() == ".gz" && path.stem().extension() == ".nii";
      if (!isPacked && path.extension() != ".nii")
      {
        throw cactus::InvalidInput("FileName is '" + stage.fileName + "': name a file that ends in .nii or .nii.gz");
      }
      const ScratchFolder folder;
      const fs::path whole = folder.file(isPacked ? "image.nii.gz" : "image.nii");
      const bool isPlaced = cactus::placementOf(this->GetInput()).has_value();
      cactus::requireFileUnit(stage.lengthUnit, isPlaced);
      const auto image = withArray(imageOf(this->GetInput()), stage.array);
      if (!isPlaced)
      {
        cactus::placeGrid(image, cactus::Placement().in(stage.lengthUnit));
      }
      write(image, stage.lengthUnit, whole.string());
      place(whole, stage.fileName);
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
