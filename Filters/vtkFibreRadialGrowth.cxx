// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFibreRadialGrowth.h"

#include "FibreData.h"
#include "FibreRadialGrowth.h"
#include "FilterSupport.h"
#include "GrowthTarget.h"
#include "Memory.h"
#include "WholeData.h"

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
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <memory>
#include <sstream>
#include <utility>

vtkStandardNewMacro(vtkFibreRadialGrowth);

namespace
{

cactus::FibreRadialGrowthOptions optionsFrom(vtkFibreRadialGrowth* self)
{
  cactus::FibreRadialGrowthOptions options;
  options.voxelSize = self->GetVoxelSize();
  options.targetFibreVolumeFraction = self->GetTargetFibreVolumeFraction();
  options.growthIterations = self->GetGrowthIterations();
  options.minimumGap = self->GetMinimumGap();
  options.surfaceTolerance = self->GetSurfaceTolerance();
  options.surfaceRoughness = self->GetSurfaceRoughness();
  options.margin = self->GetMargin();
  options.seed = cactus::seedFrom(self->GetSeed());
  cactus::validate(options);
  return options;
}

void addNumber(vtkFieldData* data, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data->AddArray(array);
}

template <typename Array, typename Values>
void addColumn(vtkFieldData* data, const char* name, const Values& values)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    array->SetValue(static_cast<vtkIdType>(i), values[i]);
  }
  data->AddArray(array);
}

} // namespace

vtkFibreRadialGrowth::vtkFibreRadialGrowth() = default;

vtkFibreRadialGrowth::~vtkFibreRadialGrowth() = default;

int vtkFibreRadialGrowth::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkFibreRadialGrowth::RequestInformation(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 1);
  // A place holder: the pipeline wants to see an extent even where there cannot be an image.
  int extent[6] = { 0, 0, 0, 0, 0, 0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);

  // Only the fibres themselves say how large the domain is. Whoever updated them before may have asked this process for another
  // piece of them, which holds nothing.
  cactus::requestWholeInputs(inputs, 1);
  int port = 0;
  vtkAlgorithm* producer = this->GetInputAlgorithm(0, 0, port);
  producer->Update(port);
  auto* input = vtkPolyData::GetData(inputs[0]);
  if (input == nullptr || input->GetNumberOfPoints() == 0)
  {
    // Whoever made it has said why, or RequestData will.
    return 1;
  }
  try
  {
    const cactus::VoxelGrid grid = cactus::growthGrid(cactus::fibresFrom(input).domain, optionsFrom(this));
    const double spacing[3] = { grid.spacing, grid.spacing, grid.spacing };
    for (int axis = 0; axis < 3; ++axis)
    {
      extent[2 * axis + 1] = grid.count[axis] - 1;
    }
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    info->Set(vtkDataObject::ORIGIN(), grid.origin.data(), 3);
    info->Set(vtkDataObject::SPACING(), spacing, 3);
  }
  catch (const cactus::Error&)
  {
    // The same checks fail in RequestData, which reports them; an error here would be followed by the pipeline's own, which say
    // less.
  }
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
      const auto options = optionsFrom(this);
      auto* input = vtkPolyData::GetData(inputs[0]);
      const cactus::Fibres fibres = cactus::fibresFrom(input);
      const cactus::Context context = cactus::contextFor(this, this->NumberOfThreads);

      vtkInformation* info = outputs->GetInformationObject(0);
      int extent[6];
      info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
      cactus::VoxelGrid grid = cactus::growthGrid(fibres.domain, options);
      double voxels = 1.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        grid.lower[axis] = extent[2 * axis];
        grid.count[axis] = extent[2 * axis + 1] - extent[2 * axis] + 1;
        voxels *= grid.count[axis];
      }
      auto* output = vtkImageData::GetData(outputs);
      if (grid.count[0] <= 0 || grid.count[1] <= 0 || grid.count[2] <= 0)
      {
        // A process with nothing to do: there are more of them than the image can be split for.
        output->Initialize();
        return;
      }
      std::ostringstream what;
      what << "VoxelSize " << this->VoxelSize << " makes an image of " << grid.count[0] << " x " << grid.count[1] << " x "
           << grid.count[2] << " voxels, which";
      cactus::requireMemory(8.0 * voxels, what.str(), "choose a larger VoxelSize or ask for a smaller extent");

      if (this->GrowthParameterTime != this->GetMTime() || this->GrowthInputTime != input->GetMTime())
      {
        vtkDataArray* converged = input->GetFieldData()->GetArray("Converged");
        if (converged != nullptr && converged->GetNumberOfTuples() > 0 && converged->GetComponent(0, 0) == 0.0)
        {
          vtkWarningMacro(<< "these fibres still overlap (Converged is 0) and take space from each other: let "
                             "CapsuleOptimizer run on or, where it keeps its history, go to the last time step");
        }
        // Nothing is kept of a search that fails.
        this->Aimed.reset();
        this->GrowthParameterTime = 0;
        auto aimed = std::make_unique<cactus::Fibres>(cactus::aimAtTargetRadii(fibres, options, context));
        this->Growth = cactus::growthFor(*aimed, options, context);
        this->Aimed = std::move(aimed);
        this->GrowthParameterTime = this->GetMTime();
        this->GrowthInputTime = input->GetMTime();
      }

      vtkNew<vtkIntArray> fibreId;
      fibreId->SetName("FibreId");
      fibreId->SetNumberOfValues(static_cast<vtkIdType>(grid.size()));
      vtkNew<vtkFloatArray> depth;
      depth->SetName("Depth");
      depth->SetNumberOfValues(static_cast<vtkIdType>(grid.size()));
      cactus::growFibres(*this->Aimed, options, this->Growth, grid, fibreId->GetPointer(0), depth->GetPointer(0), context);

      output->SetExtent(extent);
      output->SetOrigin(grid.origin.data());
      output->SetSpacing(grid.spacing, grid.spacing, grid.spacing);
      output->GetPointData()->AddArray(fibreId);
      output->GetPointData()->AddArray(depth);
      output->GetPointData()->SetActiveScalars("Depth");

      cactus::setDomain(output, fibres.domain);
      vtkFieldData* data = output->GetFieldData();
      addNumber(data, "Growth", this->Growth);
      addNumber(data, "MinimumGap", options.minimumGap);
      addNumber(data, "SurfaceTolerance", options.surfaceTolerance);
      addNumber(data, "VoxelSize", grid.spacing);
      addColumn<vtkIntArray>(data, "FibreTable.FibreId", fibres.fibreIds);
      addColumn<vtkIntArray>(data, "FibreTable.BundleId", fibres.bundleIds);
      addColumn<vtkDoubleArray>(data, "FibreTable.TargetRadius", fibres.targetRadii);

      std::ostringstream parameters;
      parameters.precision(15);
      parameters << "VoxelSize=" << options.voxelSize << " TargetFibreVolumeFraction=" << options.targetFibreVolumeFraction
                 << " GrowthIterations=" << options.growthIterations << " MinimumGap=" << options.minimumGap
                 << " SurfaceTolerance=" << options.surfaceTolerance << " SurfaceRoughness=" << options.surfaceRoughness
                 << " Margin=" << options.margin << " Seed=" << this->Seed << " (spacing " << grid.spacing << ", growth "
                 << this->Growth << " µm)";
      cactus::addProvenance(input, output, "FibreRadialGrowth", parameters.str());
    });
}

void vtkFibreRadialGrowth::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "VoxelSize: " << this->VoxelSize << '\n'
     << indent << "TargetFibreVolumeFraction: " << this->TargetFibreVolumeFraction << '\n'
     << indent << "GrowthIterations: " << this->GrowthIterations << '\n'
     << indent << "MinimumGap: " << this->MinimumGap << '\n'
     << indent << "SurfaceTolerance: " << this->SurfaceTolerance << '\n'
     << indent << "SurfaceRoughness: " << this->SurfaceRoughness << '\n'
     << indent << "Margin: " << this->Margin << '\n'
     << indent << "Seed: " << this->Seed << '\n'
     << indent << "NumberOfThreads: " << this->NumberOfThreads << '\n';
}
