// SPDX-License-Identifier: BSD-3-Clause
#include "NiftiFile.h"

#include "base/ByteOrder.h"
#include "base/Error.h"
#include "base/Memory.h"
#include "base/Numbers.h"
#include "io/GzipFile.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>

#include <Eigen/LU>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace cactus
{

namespace fs = std::filesystem;

NiftiFile::NiftiFile(const std::string& path)
  : Path(path)
{
  require(!path.empty(), "FileName is empty: name the image to read");
  std::error_code error;
  if (!fs::is_regular_file(path, error))
  {
    throw FileError("cannot open " + path + ": there is no such file");
  }
  vtkNew<vtkCallbackCommand> listener;
  listener->SetClientData(this);
  listener->SetCallback(&NiftiFile::hear);
  for (vtkObject* object : { static_cast<vtkObject*>(this->Reader), static_cast<vtkObject*>(this->Reader->GetExecutive()) })
  {
    object->AddObserver(vtkCommand::ErrorEvent, listener);
    object->AddObserver(vtkCommand::WarningEvent, listener);
  }
  this->requireKnownType();
  this->Reader->SetFileName(path.c_str());
  this->Reader->TimeAsVectorOn();
  this->Reader->UpdateInformation();
  this->throwFault();
  this->validate();
}

int NiftiFile::components() const
{
  return this->stored()->Get(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS());
}

int NiftiFile::storedType() const
{
  return this->stored()->Get(vtkDataObject::FIELD_ARRAY_TYPE());
}

int NiftiFile::valueType() const
{
  const int stored = this->storedType();
  const bool isShort = vtkDataArray::GetDataTypeSize(stored) <= 2 || stored == VTK_FLOAT;
  return this->isScaled() ? (isShort ? VTK_FLOAT : VTK_DOUBLE) : stored;
}

vtkDataArray* NiftiFile::numbers()
{
  const double count = double(this->size(0)) * double(this->size(1)) * double(this->size(2)) * this->components();
  requireMemory(count * (vtkDataArray::GetDataTypeSize(this->storedType()) + vtkDataArray::GetDataTypeSize(this->valueType())),
    this->Path, "choose volumes from it first");
  this->Reader->Update();
  this->throwFault();
  vtkDataArray* numbers = this->Reader->GetOutput()->GetPointData()->GetScalars();
  if (numbers == nullptr)
  {
    this->fail("VTK reads no voxels from it");
  }
  return numbers;
}

std::vector<double> NiftiFile::voxel(const std::array<std::size_t, 3>& place)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (place[axis] >= this->size(int(axis)))
    {
      throw InvalidInput(text("voxel ", place[0], ' ', place[1], ' ', place[2], " lies outside ", this->Path, ", which has ",
        this->size(0), " x ", this->size(1), " x ", this->size(2), " voxels, numbered from 0"));
    }
  }
  const auto i = static_cast<int>(place[0]);
  const auto j = static_cast<int>(place[1]);
  const auto last = static_cast<int>(this->size(2)) - 1;
  const int k = this->Reader->GetQFac() < 0.0 ? last - static_cast<int>(place[2]) : static_cast<int>(place[2]);
  // All slices, since VTK's reader does not reverse the number of a single one.
  const std::array<int, 6> column{ i, i, j, j, 0, last };
  this->Reader->UpdateExtent(column.data());
  this->throwFault();
  vtkImageData* image = this->Reader->GetOutput();
  if (image->GetPointData()->GetScalars() == nullptr)
  {
    this->fail("VTK reads no voxels from it");
  }
  std::vector<double> values;
  for (int component = 0; component < this->components(); ++component)
  {
    const double stored = image->GetScalarComponentAsDouble(i, j, k, component);
    values.push_back(this->Slope * stored + this->Intercept);
  }
  return values;
}

void NiftiFile::hear(vtkObject* object, unsigned long event, void* self, void* message)
{
  std::string& fault = static_cast<NiftiFile*>(self)->Fault;
  if (event != vtkCommand::ErrorEvent || !fault.empty() || message == nullptr || !object->IsA("vtkNIFTIImageReader"))
  {
    return; // the first says why
  }
  // "ERROR: In FILE, line N\nCLASS (ADDRESS): WHY"
  fault = static_cast<const char*>(message);
  const std::size_t why = fault.find("): ");
  fault = fault.substr(why == std::string::npos ? 0 : why + 3);
  fault.erase(fault.find_last_not_of(" .\n") + 1);
}

void NiftiFile::fail(const std::string& why) const
{
  throw FileError(this->Path + ": " + why);
}

void NiftiFile::throwFault() const
{
  if (!this->Fault.empty() || this->Reader->GetErrorCode() != 0)
  {
    this->fail(this->Fault.empty() ? "it cannot be read" : this->Fault);
  }
}

vtkInformation* NiftiFile::stored() const
{
  return vtkDataObject::GetActiveFieldInformation(
    this->Reader->GetOutputInformation(0), vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

void NiftiFile::requireKnownType() const
{
  fs::path headerFile = this->Path;
  std::error_code error;
  if (headerFile.extension() == ".img" && fs::exists(fs::path(headerFile).replace_extension(".hdr"), error))
  {
    headerFile.replace_extension(".hdr");
  }
  std::array<std::int16_t, 37> words{};
  const std::string bytes = beginningOfFile(headerFile.string(), sizeof words);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  const auto begins = [&](std::int16_t size) { return words[0] == size || words[1] == size; }; // with the header's size
  constexpr std::int16_t first = 348;
  constexpr std::int16_t second = 540; // NIfTI-2
  if (!begins(first) && !begins(second))
  {
    swapBytes(words.data(), words.size());
  }
  if (bytes.size() < sizeof words || (!begins(first) && !begins(second)))
  {
    return; // VTK's reader says what is wrong
  }
  constexpr std::array<std::array<int, 2>, 14> types{ { { 2, 8 }, { 4, 16 }, { 8, 32 }, { 16, 32 }, { 32, 64 }, { 64, 64 },
    { 128, 24 }, { 256, 8 }, { 512, 16 }, { 768, 32 }, { 1024, 64 }, { 1280, 64 }, { 1792, 128 }, { 2304, 32 } } };
  const std::size_t place = begins(second) ? 6 : 35;
  const std::array<int, 2> type{ words[place], words[place + 1] };
  if (std::find(types.begin(), types.end(), type) == types.end())
  {
    this->fail(text("its voxels have type ", type[0], " with ", type[1],
      " bits: whole numbers of 8 to 64 bits, floating-point and complex numbers of single and double precision and colours can "
      "be read"));
  }
}

void NiftiFile::validate()
{
  vtkNIFTIImageHeader& header = this->header();
  const std::string magic(header.GetMagic(), 3);
  if (magic != "n+1" && magic != "ni1" && magic != "n+2" && magic != "ni2")
  {
    this->fail("this is no NIfTI image");
  }
  const bool hasOwnFile = magic[1] == 'i'; // of its voxels
  if (hasOwnFile && fs::path(this->Path).filename().string().find(".nii") != std::string::npos)
  {
    this->fail("its voxels are in another file: name header and voxels alike, NAME.hdr and NAME.img");
  }
  this->validateDimensions();
  const vtkTypeInt64 least = hasOwnFile ? 0 : magic[2] == '2' ? 544 : 352; // behind the header and the mark of extensions
  if (header.GetVoxOffset() < least)
  {
    this->fail(text("its header places the voxels at byte ", header.GetVoxOffset(), " of the file"));
  }
  this->readScale(header.GetDataType());
  this->readPlace();
}

void NiftiFile::validateDimensions() const
{
  const vtkTypeInt64 rank = this->dimension(0);
  if (rank < 1)
  {
    this->fail(text("its header gives the image ", rank, " dimensions"));
  }
  for (int i = 1; i <= rank; ++i)
  {
    if (this->dimension(i) < 1)
    {
      this->fail(text("its header gives the image ", this->dimension(i), " voxels along dimension ", i));
    }
    if (i > 5 && this->dimension(i) > 1)
    {
      this->fail(text("it has ", rank, " dimensions: images of three, series (the fourth) and vectors (the fifth) can be read"));
    }
  }
}

void NiftiFile::readScale(int type)
{
  const double slope = this->header().GetSclSlope();
  const double intercept = this->header().GetSclInter();
  const bool isColour = type == 128 || type == 2304;
  // 0 says that there is no scale. NaN is what nibabel writes for it before it knows one.
  if (slope == 0.0 || std::isnan(slope) || isColour)
  {
    return;
  }
  if (!std::isfinite(slope) || !std::isfinite(intercept))
  {
    this->fail(text("its header scales numbers by ", slope, " and adds ", intercept));
  }
  this->Slope = slope;
  this->Intercept = intercept;
}

void NiftiFile::readPlace()
{
  vtkNIFTIImageHeader& header = this->header();
  vtkMatrix4x4* matrix = header.GetSFormCode() > 0   ? this->Reader->GetSFormMatrix()
                         : header.GetQFormCode() > 0 ? this->Reader->GetQFormMatrix()
                                                     : nullptr;
  if (matrix == nullptr)
  {
    this->fail(
      "it does not say where it lies: the codes of its s-form and of its q-form are 0. Set one, for instance by mrconvert or "
      "nibabel");
  }
  const int unit = header.GetXYZTUnits() & 7;
  const double millimetres = unit == 1 ? 1000.0 : unit == 3 ? 0.001 : 1.0; // m; µm; mm, or no unit
  const double* spacing = this->Reader->GetOutputInformation(0)->Get(vtkDataObject::SPACING());
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      this->ToScanner.matrix()(row, column) =
        millimetres * matrix->GetElement(row, column) * (column < 3 ? spacing[column] : 1.0);
    }
  }
  const Eigen::Matrix3d axes = this->ToScanner.linear();
  // The volume of a voxel as a fraction of that which the same edges would have at right angles.
  if (!this->ToScanner.matrix().allFinite() || this->ToScanner.matrix().cwiseAbs().maxCoeff() > 1e12 ||
      !(std::abs(axes.determinant()) > 1e-6 * axes.colwise().norm().prod()))
  {
    const Eigen::IOFormat rows(4, Eigen::DontAlignCols, " ", ", ");
    TextStream affine;
    affine << this->ToScanner.matrix().topRows(3).format(rows);
    this->fail("the affine of its header, " + affine.str() + ", leaves the image no volume");
  }
}

} // namespace cactus
