// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFibreRadialGrowth.h"

#include "Columns.h"
#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "InputBlocks.h"
#include "OverlapRemark.h"
#include "StageProperties.h"
#include "WholeData.h"
#include "base/Error.h"
#include "base/Memory.h"
#include "base/Numbers.h"
#include "fibres/FibreShape.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"
#include "judge/SubstrateStatistics.h"
#include "stages/StageWork.h"
#include "stages/Stages.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkFibreRadialGrowth);

namespace
{

/// Returns the requested part of the image. Throws InvalidInput if it belongs to an image that these fibres do not make, and
/// OutOfMemory if it does not fit into memory.
cactus::VoxelGrid requestedGrid(
  const cactus::Domain& domain, const cactus::FibreRadialGrowthOptions& options, vtkInformation* info)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  cactus::VoxelGrid grid = cactus::growthGrid(domain, options);
  int extent[6];
  info->Get(Pipeline::WHOLE_EXTENT(), extent);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (extent[2 * axis + 1] != grid.count[axis] - 1)
    {
      throw cactus::InvalidInput(
        "the fibres' Domain has changed since the size of the image was asked for: it has to be the same "
        "at all times");
    }
  }
  info->Get(Pipeline::UPDATE_EXTENT(), extent);
  double voxels = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.lower[axis] = extent[2 * axis];
    grid.count[axis] = std::max(0, extent[2 * axis + 1] - extent[2 * axis] + 1);
    voxels *= grid.count[axis];
  }
  cactus::TextStream what;
  what << "VoxelSize " << options.voxelSize << " makes an image of " << grid.count[0] << " x " << grid.count[1] << " x "
       << grid.count[2] << " voxels, which";
  cactus::requireMemory(8.0 * voxels, what.str(), "choose a larger VoxelSize or ask for a smaller extent");
  return grid;
}

/// Adds field data for MyelinSurface, the certificate and the user.
void addImageFacts(const cactus::Fibres& fibres, const cactus::FibreRadialGrowthOptions& options, double spacing,
  const cactus::SolvedGrowth& growth, vtkImageData* output)
{
  cactus::setDomain(output, fibres.domain);
  vtkFieldData* data = output->GetFieldData();
  cactus::addNumber(data, "Growth", growth.growth);
  if (const double target = cactus::targetFraction(fibres, options); target > 0.0)
  {
    // The target, or what could be reached of it.
    cactus::addNumber(data, "FibreVolumeFraction", growth.fraction > 0.0 ? growth.fraction : target);
  }
  cactus::addNumber(data, "MinimumGap", options.minimumGap);
  cactus::addNumber(data, "SurfaceTolerance", options.surfaceTolerance);
  cactus::addNumber(data, "VoxelSize", spacing);
  cactus::addColumn<vtkIntArray>(data, "FibreTable.FibreId", fibres.size(), [&](std::size_t f) { return fibres.fibreIds[f]; });
  cactus::addColumn<vtkIntArray>(data, "FibreTable.BundleId", fibres.size(), [&](std::size_t f) { return fibres.bundleIds[f]; });
  cactus::addColumn<vtkDoubleArray>(
    data, "FibreTable.TargetRadius", fibres.size(), [&](std::size_t f) { return fibres.targetRadii[f]; });
  cactus::addColumns(fibres, "FibreTable.", data);
  // 0 for one that only passes outside.
  cactus::addColumn<vtkDoubleArray>(
    data, "FibreTable.LengthInDomain", fibres.size(), [&](std::size_t f) { return cactus::lengthInDomain(fibres, f); });
}

} // namespace

vtkFibreRadialGrowth::vtkFibreRadialGrowth()
  : Properties(cactus::makeProperties<cactus::FibreRadialGrowthStage>())
{
}

vtkFibreRadialGrowth::~vtkFibreRadialGrowth() = default;

int vtkFibreRadialGrowth::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

int vtkFibreRadialGrowth::RequestInformation(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 1);
  // A place holder: the pipeline needs an extent even if there is no image.
  int extent[6] = { 0, 0, 0, 0, 0, 0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);

  // Only the fibres themselves determine the domain.
  cactus::quietly(
    [&]
    {
      cactus::updateWholeInputs(this, inputs);
      const cactus::Domain domain = cactus::fibresFrom(vtkDataObject::GetData(inputs[0])).domain;
      const cactus::VoxelGrid grid =
        cactus::growthGrid(domain, cactus::stageOf<cactus::FibreRadialGrowthStage>(this->Properties).options);
      const double spacing[3] = { grid.spacing, grid.spacing, grid.spacing };
      for (int axis = 0; axis < 3; ++axis)
      {
        extent[2 * axis + 1] = grid.count[axis] - 1;
      }
      info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
      info->Set(vtkDataObject::ORIGIN(), grid.origin.data(), 3);
      info->Set(vtkDataObject::SPACING(), spacing, 3);
    });
  return 1;
}

int vtkFibreRadialGrowth::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // Any part of the image may need any fibre.
  cactus::requestWholeInputs(inputs, 1);
  return 1;
}

int vtkFibreRadialGrowth::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::FibreRadialGrowthStage>(this->Properties);
      cactus::validateProperties(stage);
      auto* input = vtkDataObject::GetData(inputs[0]);
      const cactus::Fibres fibres = cactus::fibresFrom(input);
      const cactus::FibreRadialGrowthOptions options = cactus::forFibres(fibres, stage.options);
      this->Fibres.TakeReference(input->NewInstance());
      this->Fibres->ShallowCopy(input);
      const cactus::Context context = cactus::contextFor(this, stage.threads);
      vtkInformation* info = outputs->GetInformationObject(0);
      const cactus::VoxelGrid grid = requestedGrid(fibres.domain, options, info);
      auto* output = vtkImageData::GetData(outputs);
      if (grid.size() == 0)
      {
        // A process with nothing to do: the image cannot be split for that many.
        output->Initialize();
        return;
      }

      this->solve(input, fibres, options, context);

      auto fibreId = cactus::makeArray<vtkIntArray>("FibreId", grid.size());
      auto depth = cactus::makeArray<vtkFloatArray>("Depth", grid.size());
      cactus::growFibres(
        *this->Aimed, options, this->Growth->growth, grid, fibreId->GetPointer(0), depth->GetPointer(0), context);

      output->SetExtent(info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()));
      output->SetOrigin(grid.origin.data());
      output->SetSpacing(grid.spacing, grid.spacing, grid.spacing);
      output->GetPointData()->AddArray(fibreId);
      output->GetPointData()->AddArray(depth);
      output->GetPointData()->SetActiveScalars("Depth");

      addImageFacts(fibres, options, grid.spacing, *this->Growth, output);
      if (!fibres.myelinFractions.empty())
      {
        cactus::addNumber(output->GetFieldData(), cactus::saysMyelinName, 1.0);
      }
      cactus::setProvenance(output,
        cactus::recordOf(this, "FibreRadialGrowth", stage, { "Input" }, cactus::growthReached(grid.spacing, *this->Growth)), 0);
    });
}

void vtkFibreRadialGrowth::solve(vtkDataObject* input, const cactus::Fibres& fibres,
  const cactus::FibreRadialGrowthOptions& options, const cactus::Context& context)
{
  if (this->GrowthParameterTime == this->GetMTime() && this->GrowthInputTime == cactus::changeTime(input))
  {
    return;
  }
  const auto say = [this](const std::string& remark)
  {
    if (!remark.empty())
    {
      vtkWarningMacro(<< remark);
    }
  };
  say(cactus::remarkOnOverlaps(input, fibres, context.threadCount()));
  say(cactus::remarkOnTarget(fibres, options));
  // A search that fails leaves nothing behind.
  this->Aimed.reset();
  this->GrowthParameterTime = 0;
  auto aimed = std::make_unique<cactus::Fibres>(cactus::aimAtTargetRadii(fibres, options, context));
  this->Growth = std::make_unique<cactus::SolvedGrowth>(cactus::growthFor(*aimed, options, context));
  say(cactus::remarkOnGrowth(fibres, options, *this->Growth));
  this->Aimed = std::move(aimed);
  this->GrowthParameterTime = this->GetMTime();
  this->GrowthInputTime = cactus::changeTime(input);
}
