// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNiftiReader.h"

#include "DataProvenance.h"
#include "FilterSupport.h"
#include "NiftiFile.h"
#include "StageProperties.h"
#include "WholeData.h"
#include "base/LengthUnit.h"
#include "stages/StageWork.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
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

  NiftiGrid(const cactus::NiftiFile& file, cactus::LengthUnit unit)
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

  void arrange(
    const cactus::NiftiFile& file, cactus::LengthUnit unit, const Eigen::Vector3d& edges, const Eigen::Matrix3d& directions)
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
vtkSmartPointer<vtkDataArray> valuesOf(cactus::NiftiFile& file, const NiftiGrid& grid, const cactus::Context& context)
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
      const cactus::NiftiFile file(stage.fileName);
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
      cactus::NiftiFile file(stage.fileName);
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
