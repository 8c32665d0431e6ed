// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNiftiReader.h"

#include "DataProvenance.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "WholeData.h"
#include "base/Error.h"
#include "base/LengthUnit.h"
#include "base/Memory.h"
#include "base/Numbers.h"
#include "stages/StageWork.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>

vtkStandardNewMacro(vtkNiftiReader);

namespace
{

namespace fs = std::filesystem;

/// VTK's reader of one file, whose faults are exceptions.
class NiftiFile
{
public:
  /// Reads the header. Throws InvalidInput without a name, and FileError for a header that cannot be true.
  explicit NiftiFile(const std::string& path)
    : Path(path)
  {
    cactus::require(!path.empty(), "FileName is empty: name the image to read");
    std::error_code error;
    if (!fs::is_regular_file(path, error))
    {
      throw cactus::FileError("cannot open " + path + ": there is no such file");
    }
    vtkNew<vtkCallbackCommand> listener;
    listener->SetClientData(this);
    listener->SetCallback(&NiftiFile::hear);
    for (vtkObject* object : { static_cast<vtkObject*>(this->Reader), static_cast<vtkObject*>(this->Reader->GetExecutive()) })
    {
      object->AddObserver(vtkCommand::ErrorEvent, listener);
      object->AddObserver(vtkCommand::WarningEvent, listener);
    }
    this->Reader->SetFileName(path.c_str());
    this->Reader->TimeAsVectorOn();
    this->Reader->UpdateInformation();
    this->throwFault();
    this->validate();
  }
  NiftiFile(const NiftiFile&) = delete;
  NiftiFile& operator=(const NiftiFile&) = delete;
  ~NiftiFile() { this->Reader->RemoveAllObservers(); }

  vtkNIFTIImageHeader& header() const { return *this->Reader->GetNIFTIHeader(); }
  std::size_t size(int axis) const { return static_cast<std::size_t>(std::max<vtkTypeInt64>(1, this->dimension(axis + 1))); }
  /// Numbers of a voxel: volumes of a series, of a vector, of a colour or of a complex number.
  int components() const { return this->stored()->Get(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS()); }
  /// VTK's type of the numbers stored.
  int storedType() const { return this->stored()->Get(vtkDataObject::FIELD_ARRAY_TYPE()); }
  /// A value is slope times the number stored, plus the intercept.
  bool isScaled() const { return this->Slope != 1.0 || this->Intercept != 0.0; }
  double slope() const { return this->Slope; }
  double intercept() const { return this->Intercept; }
  /// VTK's type of the values.
  int valueType() const
  {
    const int stored = this->storedType();
    const bool isShort = vtkDataArray::GetDataTypeSize(stored) <= 2 || stored == VTK_FLOAT;
    return this->isScaled() ? (isShort ? VTK_FLOAT : VTK_DOUBLE) : stored;
  }
  /// From i, j, k of VTK's image, which may have the slices of the file in reverse, to mm of the scanner.
  const Eigen::Affine3d& toScanner() const { return this->ToScanner; }

  /// Reads all numbers as they are stored. Throws FileError and OutOfMemory.
  vtkDataArray* numbers()
  {
    const double count = double(this->size(0)) * double(this->size(1)) * double(this->size(2)) * this->components();
    cactus::requireMemory(
      count * (vtkDataArray::GetDataTypeSize(this->storedType()) + vtkDataArray::GetDataTypeSize(this->valueType())), this->Path,
      "choose volumes from it first");
    this->Reader->Update();
    this->throwFault();
    vtkDataArray* numbers = this->Reader->GetOutput()->GetPointData()->GetScalars();
    if (numbers == nullptr)
    {
      this->fail("VTK reads no voxels from it");
    }
    return numbers;
  }

private:
  static void hear(vtkObject* object, unsigned long event, void* self, void* message)
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

  [[noreturn]] void fail(const std::string& why) const { throw cactus::FileError(this->Path + ": " + why); }

  void throwFault() const
  {
    if (!this->Fault.empty() || this->Reader->GetErrorCode() != 0)
    {
      this->fail(this->Fault.empty() ? "it cannot be read" : this->Fault);
    }
  }

  /// What VTK's reader says of the numbers before it reads them.
  vtkInformation* stored() const
  {
    return vtkDataObject::GetActiveFieldInformation(
      this->Reader->GetOutputInformation(0), vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  }

  vtkTypeInt64 dimension(int i) const { return this->header().GetDim(i); }

  /// Refuses what VTK's reader takes at its word.
  void validate()
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
    constexpr std::array<std::array<int, 2>, 14> types{ { { 2, 8 }, { 4, 16 }, { 8, 32 }, { 16, 32 }, { 32, 64 }, { 64, 64 },
      { 128, 24 }, { 256, 8 }, { 512, 16 }, { 768, 32 }, { 1024, 64 }, { 1280, 64 }, { 1792, 128 }, { 2304, 32 } } };
    const std::array<int, 2> type{ header.GetDataType(), header.GetBitPix() };
    if (std::find(types.begin(), types.end(), type) == types.end())
    {
      this->fail(cactus::text("its voxels have type ", type[0], " with ", type[1],
        " bits: whole numbers of 8 to 64 bits, floating-point and complex numbers of single and double precision and colours can "
        "be read"));
    }
    const vtkTypeInt64 least = hasOwnFile ? 0 : magic[2] == '2' ? 544 : 352; // behind the header and the mark of extensions
    if (header.GetVoxOffset() < least)
    {
      this->fail(cactus::text("its header places the voxels at byte ", header.GetVoxOffset(), " of the file"));
    }
    this->readScale(type[0]);
    this->readPlace();
  }

  /// VTK's reader itself refuses more than seven, and negative ones.
  void validateDimensions() const
  {
    const vtkTypeInt64 rank = this->dimension(0);
    if (rank < 1)
    {
      this->fail(cactus::text("its header gives the image ", rank, " dimensions"));
    }
    for (int i = 1; i <= rank; ++i)
    {
      if (this->dimension(i) < 1)
      {
        this->fail(cactus::text("its header gives the image ", this->dimension(i), " voxels along dimension ", i));
      }
      if (i > 5 && this->dimension(i) > 1)
      {
        this->fail(
          cactus::text("it has ", rank, " dimensions: images of three, series (the fourth) and vectors (the fifth) can be read"));
      }
    }
  }

  void readScale(int type)
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
      this->fail(cactus::text("its header scales numbers by ", slope, " and adds ", intercept));
    }
    this->Slope = slope;
    this->Intercept = intercept;
  }

  void readPlace()
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
      cactus::TextStream affine;
      affine << this->ToScanner.matrix().topRows(3).format(rows);
      this->fail("the affine of its header, " + affine.str() + ", leaves the image no volume");
    }
  }

  std::string Path;
  std::string Fault;
  vtkNew<vtkNIFTIImageReader> Reader;
  double Slope = 1.0;
  double Intercept = 0.0;
  Eigen::Affine3d ToScanner = Eigen::Affine3d::Identity();
};

/// A grid of the same voxels whose axes are those of the file in another order, some of them reversed, so that the first one
/// leads to the right as much as any does, the second to the front and the third up. Its axes form a right-handed system.
struct NiftiGrid
{
  std::array<int, 3> fileAxis{};    ///< axis of the file along each axis
  std::array<bool, 3> isReversed{}; ///< whether it leads backwards
  std::array<std::size_t, 3> size{};
  std::array<int, 6> extent{};
  Eigen::Vector3d origin, spacing; ///< in the output's unit
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> axes;

  NiftiGrid(const NiftiFile& file, cactus::LengthUnit unit)
  {
    const Eigen::Vector3d edges = file.toScanner().linear().colwise().norm();
    const Eigen::Matrix3d directions = file.toScanner().linear() * edges.cwiseInverse().asDiagonal();
    // Pairs of an axis of space and one of the file, the closest first.
    Eigen::Matrix3d left = directions.cwiseAbs();
    for (int pair = 0; pair < 3; ++pair)
    {
      Eigen::Index space = 0;
      Eigen::Index axis = 0;
      left.maxCoeff(&space, &axis);
      left.row(space).setConstant(-1.0);
      left.col(axis).setConstant(-1.0);
      this->fileAxis[std::size_t(space)] = int(axis);
      this->isReversed[std::size_t(space)] = directions(space, axis) < 0.0;
    }
    this->arrange(file, unit, edges, directions);
    if (this->axes.determinant() < 0.0) // sheared so far that none of them leads along its axis of space
    {
      this->isReversed[2] = !this->isReversed[2];
      this->arrange(file, unit, edges, directions);
    }
  }

  /// Returns the place in the file's order of the voxel at (i, j, k), and of the next one along i.
  std::array<vtkIdType, 2> placeOf(std::size_t j, std::size_t k) const
  {
    std::array<vtkIdType, 3> step{}; // in the file, along the file's axes
    vtkIdType along = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      step[std::size_t(axis)] = along;
      along *= static_cast<vtkIdType>(this->size[this->gridAxis(axis)]);
    }
    vtkIdType place = 0;
    const std::array<std::size_t, 3> index{ 0, j, k };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto at = static_cast<vtkIdType>(this->isReversed[axis] ? this->size[axis] - 1 - index[axis] : index[axis]);
      place += at * step[std::size_t(this->fileAxis[axis])];
    }
    return { place, (this->isReversed[0] ? -1 : 1) * step[std::size_t(this->fileAxis[0])] };
  }

private:
  std::size_t gridAxis(int file) const
  {
    return std::size_t(std::find(this->fileAxis.begin(), this->fileAxis.end(), file) - this->fileAxis.begin());
  }

  void arrange(const NiftiFile& file, cactus::LengthUnit unit, const Eigen::Vector3d& edges, const Eigen::Matrix3d& directions)
  {
    const double length = cactus::micrometresIn(cactus::LengthUnit::Millimetre) / cactus::micrometresIn(unit); // of 1 mm
    Eigen::Vector3d first = Eigen::Vector3d::Zero(); // voxel of the file
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Eigen::Index of = this->fileAxis[axis];
      const auto column = Eigen::Index(axis);
      this->size[axis] = file.size(int(of));
      this->extent[2 * axis + 1] = static_cast<int>(this->size[axis]) - 1;
      this->spacing[column] = length * edges[of];
      this->axes.col(column) = (this->isReversed[axis] ? -1.0 : 1.0) * directions.col(of);
      first[of] = this->isReversed[axis] ? double(this->size[axis] - 1) : 0.0;
    }
    this->origin = length * (file.toScanner() * first);
  }
};

/// Returns the values in the order of the grid.
vtkSmartPointer<vtkDataArray> valuesOf(NiftiFile& file, const NiftiGrid& grid, const cactus::Context& context)
{
  vtkDataArray* numbers = file.numbers();
  auto values = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(file.valueType()));
  values->SetNumberOfComponents(numbers->GetNumberOfComponents());
  values->SetNumberOfTuples(numbers->GetNumberOfTuples());
  vtkIdType to = 0;
  for (std::size_t k = 0; k < grid.size[2]; ++k)
  {
    for (std::size_t j = 0; j < grid.size[1]; ++j)
    {
      auto [from, step] = grid.placeOf(j, k);
      for (std::size_t i = 0; i < grid.size[0]; ++i, ++to, from += step)
      {
        if (!file.isScaled())
        {
          values->SetTuple(to, from, numbers);
          continue;
        }
        for (int component = 0; component < numbers->GetNumberOfComponents(); ++component)
        {
          values->SetComponent(to, component, file.slope() * numbers->GetComponent(from, component) + file.intercept());
        }
      }
    }
    context.checkpoint();
    context.report(double(k + 1) / double(grid.size[2]), "Arranging voxels");
  }
  return values;
}

/// Returns the name of a file without its folder and its extensions.
std::string stemOf(const std::string& path)
{
  const fs::path stem = fs::path(path).stem();
  return (fs::path(path).extension() == ".gz" ? stem.stem() : stem).string();
}

} // namespace

vtkNiftiReader::vtkNiftiReader()
  : Properties(cactus::makeProperties<cactus::NiftiReaderStage>())
{
  this->SetNumberOfInputPorts(0);
}

int vtkNiftiReader::ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time)
{
  return cactus::pipelineTime(this, time);
}

int vtkNiftiReader::CanReadFile(const char* name)
{
  std::error_code error;
  if (name == nullptr || !fs::is_regular_file(name, error))
  {
    return 0;
  }
  // A damaged .nii counts, too, if its name has no other dots: the error then says what is wrong.
  fs::path file = fs::path(name).filename();
  file = file.extension() == ".gz" ? file.stem() : file;
  vtkNew<vtkNIFTIImageReader> reader;
  return (file.extension() == ".nii" && !file.stem().has_extension()) || reader->CanReadFile(name) != 0 ? 1 : 0;
}

int vtkNiftiReader::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  const std::array<int, 6> placeHolder{}; // which the pipeline needs even if there is no image
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), placeHolder.data(), 6);
  cactus::quietly(
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::NiftiReaderStage>(this->Properties);
      const NiftiFile file(stage.fileName);
      const NiftiGrid grid(file, stage.lengthUnit);
      info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid.extent.data(), 6);
      info->Set(vtkDataObject::ORIGIN(), grid.origin.data(), 3);
      info->Set(vtkDataObject::SPACING(), grid.spacing.data(), 3);
      info->Set(vtkDataObject::DIRECTION(), grid.axes.data(), 9);
      vtkDataObject::SetPointDataActiveScalarInfo(info, file.valueType(), file.components());
    });
  return 1;
}

int vtkNiftiReader::RequestData(vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::NiftiReaderStage>(this->Properties);
      cactus::validateProperties(stage);
      auto* output = vtkImageData::GetData(outputs);
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        output->Initialize();
        return; // one rank has the image
      }
      NiftiFile file(stage.fileName);
      const NiftiGrid grid(file, stage.lengthUnit);
      const auto values = valuesOf(file, grid, cactus::contextFor(this));
      values->SetName(stemOf(stage.fileName).c_str());
      output->SetExtent(const_cast<int*>(grid.extent.data()));
      output->SetOrigin(grid.origin.data());
      output->SetSpacing(grid.spacing.data());
      output->SetDirectionMatrix(grid.axes.data());
      output->GetPointData()->SetScalars(values);
      cactus::setProvenance(output, cactus::provenanceOf(cactus::niftiRecord(stage)), 0);
    });
}

void vtkNiftiReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties->print(os, indent);
}
