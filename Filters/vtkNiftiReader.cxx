// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNiftiReader.h"

#include "Columns.h"
#include "DataProvenance.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "WholeData.h"
#include "base/LengthUnit.h"
#include "base/Memory.h"
#include "io/NiftiFile.h"
#include "stages/StageWork.h"

#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTypeFloat32Array.h>
#include <vtkTypeFloat64Array.h>
#include <vtkTypeInt16Array.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkTypeInt8Array.h>
#include <vtkTypeUInt16Array.h>
#include <vtkTypeUInt32Array.h>
#include <vtkTypeUInt64Array.h>
#include <vtkTypeUInt8Array.h>

#include <array>
#include <filesystem>
#include <string>

vtkStandardNewMacro(vtkNiftiReader);

namespace
{

using cactus::NiftiNumber;

int vtkTypeOf(NiftiNumber number)
{
  switch (number)
  {
  case NiftiNumber::Int8:
    return VTK_TYPE_INT8;
  case NiftiNumber::UInt8:
    return VTK_TYPE_UINT8;
  case NiftiNumber::Int16:
    return VTK_TYPE_INT16;
  case NiftiNumber::UInt16:
    return VTK_TYPE_UINT16;
  case NiftiNumber::Int32:
    return VTK_TYPE_INT32;
  case NiftiNumber::UInt32:
    return VTK_TYPE_UINT32;
  case NiftiNumber::Int64:
    return VTK_TYPE_INT64;
  case NiftiNumber::UInt64:
    return VTK_TYPE_UINT64;
  case NiftiNumber::Float32:
    return VTK_TYPE_FLOAT32;
  case NiftiNumber::Float64:
    break;
  }
  return VTK_TYPE_FLOAT64;
}

vtkSmartPointer<vtkDataArray> arrayOf(NiftiNumber number, const std::string& name, std::size_t count, int components)
{
  switch (number)
  {
  case NiftiNumber::Int8:
    return cactus::makeArray<vtkTypeInt8Array>(name, count, components);
  case NiftiNumber::UInt8:
    return cactus::makeArray<vtkTypeUInt8Array>(name, count, components);
  case NiftiNumber::Int16:
    return cactus::makeArray<vtkTypeInt16Array>(name, count, components);
  case NiftiNumber::UInt16:
    return cactus::makeArray<vtkTypeUInt16Array>(name, count, components);
  case NiftiNumber::Int32:
    return cactus::makeArray<vtkTypeInt32Array>(name, count, components);
  case NiftiNumber::UInt32:
    return cactus::makeArray<vtkTypeUInt32Array>(name, count, components);
  case NiftiNumber::Int64:
    return cactus::makeArray<vtkTypeInt64Array>(name, count, components);
  case NiftiNumber::UInt64:
    return cactus::makeArray<vtkTypeUInt64Array>(name, count, components);
  case NiftiNumber::Float32:
    return cactus::makeArray<vtkTypeFloat32Array>(name, count, components);
  case NiftiNumber::Float64:
    break;
  }
  return cactus::makeArray<vtkTypeFloat64Array>(name, count, components);
}

/// The grid in VTK's terms.
struct Grid
{
  std::array<int, 6> extent{};
  Eigen::Vector3d origin, spacing;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> directions;

  Grid(const cactus::NiftiGrid& grid, cactus::LengthUnit unit)
    : directions(grid.axes)
  {
    const double length = cactus::micrometresIn(cactus::LengthUnit::Millimetre) / cactus::micrometresIn(unit); // of 1 mm
    origin = length * grid.origin;
    spacing = length * grid.spacing;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      extent[2 * axis + 1] = static_cast<int>(grid.size[axis]) - 1;
    }
  }
};

/// Returns the name of a file without its folder and its extensions.
std::string stemOf(const std::string& path)
{
  const std::filesystem::path stem = std::filesystem::path(path).stem();
  return (std::filesystem::path(path).extension() == ".gz" ? stem.stem() : stem).string();
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
  return name != nullptr && cactus::isNifti(name) ? 1 : 0;
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
      const cactus::NiftiHeader header = cactus::niftiHeaderOf(stage);
      const Grid grid(cactus::NiftiGrid(header), stage.lengthUnit);
      info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid.extent.data(), 6);
      info->Set(vtkDataObject::ORIGIN(), grid.origin.data(), 3);
      info->Set(vtkDataObject::SPACING(), grid.spacing.data(), 3);
      info->Set(vtkDataObject::DIRECTION(), grid.directions.data(), 9);
      vtkDataObject::SetPointDataActiveScalarInfo(
        info, vtkTypeOf(header.valueType()), static_cast<int>(header.numbersPerVoxel()));
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
      const cactus::NiftiHeader header = cactus::niftiHeaderOf(stage);
      cactus::requireMemory(header.valueBytes(), stage.fileName, "choose volumes from it first");
      const auto array =
        arrayOf(header.valueType(), stemOf(stage.fileName), header.voxels(), static_cast<int>(header.numbersPerVoxel()));
      const cactus::NiftiGrid order(header);
      cactus::readNiftiValues(stage.fileName, header, order, array->GetVoidPointer(0), cactus::contextFor(this));
      const Grid grid(order, stage.lengthUnit);
      output->SetExtent(const_cast<int*>(grid.extent.data()));
      output->SetOrigin(grid.origin.data());
      output->SetSpacing(grid.spacing.data());
      output->SetDirectionMatrix(grid.directions.data());
      output->GetPointData()->SetScalars(array);
      cactus::setProvenance(output, cactus::provenanceOf(cactus::niftiRecord(stage)), 0);
    });
}

void vtkNiftiReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties->print(os, indent);
}
