// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubstrateSampler.h"

#include "Columns.h"
#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "ImageGrid.h"
#include "StageProperties.h"
#include "SubstrateInputs.h"
#include "WholeData.h"
#include "base/Error.h"
#include "base/SphericalHarmonics.h"
#include "judge/SubstrateSampler.h"
#include "stages/Stages.h"

#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>

vtkStandardNewMacro(vtkSubstrateSampler);

namespace
{

using cactus::addColumn;

/// The points are the middles of the voxels.
cactus::ImageGrid gridOf(const cactus::VoxelBoxes& voxels)
{
  const Eigen::Vector3d origin = voxels.origin + Eigen::Vector3d::Constant(0.5 * voxels.spacing);
  return { voxels.count, { { origin[0], origin[1], origin[2] } }, voxels.spacing };
}

void fillFractions(vtkPointData* data, const cactus::SampledSubstrate& sampled)
{
  const std::size_t size = sampled.voxels.size();
  const auto fraction = [&](const std::string& name, const auto& value) { addColumn<vtkFloatArray>(data, name, size, value); };
  fraction("AVF", [&](std::size_t i) { return sampled.axonFraction[i]; });
  fraction("MVF", [&](std::size_t i) { return sampled.myelinFraction[i]; });
  fraction("ExtraAxonalFraction",
    [&](std::size_t i) { return std::max(0.0, 1.0 - sampled.axonFraction[i] - sampled.myelinFraction[i]); });
  for (const auto& bundle : sampled.bundleFraction)
  {
    fraction("BundleFraction_" + std::to_string(bundle.first), [&](std::size_t i) { return bundle.second[i]; });
  }
}

void fillLabels(vtkPointData* data, const cactus::SampledSubstrate& sampled)
{
  const std::size_t size = sampled.voxels.size();
  addColumn<vtkUnsignedCharArray>(data, "Compartment", size, [&](std::size_t i) { return sampled.compartment[i]; });
  addColumn<vtkIntArray>(data, "FibreId", size, [&](std::size_t i) { return sampled.fibreId[i]; });
  addColumn<vtkIntArray>(data, "FibreCount", size, [&](std::size_t i) { return sampled.fibreCount[i]; });
  if (sampled.direction.empty())
  {
    return;
  }
  auto directions = cactus::makeArray<vtkFloatArray>("MeanDirection", size, 3);
  for (std::size_t i = 0; i < size; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      directions->SetTypedComponent(vtkIdType(i), axis, float(sampled.direction[i][axis]));
    }
  }
  data->AddArray(directions);
  addColumn<vtkFloatArray>(data, "Dispersion", size, [&](std::size_t i) { return sampled.dispersion[i]; });
}

/// Fibre orientation distributions.
void fillOrientations(vtkPointData* data, const cactus::SampledSubstrate& sampled)
{
  const std::size_t size = sampled.voxels.size();
  if (sampled.harmonicsOrder > 0)
  {
    auto fod = cactus::makeArray<vtkFloatArray>("FOD", size, int(cactus::harmonicCount(sampled.harmonicsOrder)));
    for (std::size_t i = 0; i < sampled.harmonics.size(); ++i)
    {
      fod->SetValue(vtkIdType(i), float(sampled.harmonics[i]));
    }
    data->AddArray(fod);
  }
  if (!sampled.peaks.empty())
  {
    constexpr int numbers = 3 * int(cactus::SampledSubstrate::peakCount);
    auto peaks = cactus::makeArray<vtkFloatArray>("Peaks", size, numbers);
    for (std::size_t i = 0; i < size; ++i)
    {
      for (int number = 0; number < numbers; ++number)
      {
        peaks->SetTypedComponent(vtkIdType(i), number, float(sampled.peaks[i][std::size_t(number / 3)][number % 3]));
      }
    }
    data->AddArray(peaks);
  }
}

} // namespace

vtkSubstrateSampler::vtkSubstrateSampler()
  : Properties(cactus::makeProperties<cactus::SubstrateSamplerStage>())
{
  this->SetNumberOfInputPorts(3);
}

int vtkSubstrateSampler::FillInputPortInformation(int port, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port > 0 ? 1 : 0);
  return 1;
}

int vtkSubstrateSampler::RequestInformation(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  cactus::announceGrid(this, inputs, outputs, VTK_FLOAT,
    [this](vtkDataObject* surfaces)
    {
      return gridOf(cactus::samplerGrid(
        cactus::domainFrom(surfaces), cactus::stageOf<cactus::SubstrateSamplerStage>(this->Properties).options));
    });
  return 1;
}

int vtkSubstrateSampler::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 3);
  return 1;
}

int vtkSubstrateSampler::RequestData(vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::SubstrateSamplerStage>(this->Properties);
      cactus::validateProperties(stage);
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        vtkImageData::GetData(outputs)->Initialize();
        return; // one rank samples; otherwise the voxels of all ranks would be joined into an image that repeats
      }
      const cactus::Substrate substrate = cactus::wholeSubstrateFrom(cactus::substrateDataOf(this, 0, 1, 2));
      const cactus::SampledSubstrate sampled = cactus::sampleSubstrate(substrate.domain, substrate.outer, substrate.inner,
        substrate.fibresOrNull(), stage.options, cactus::contextFor(this, stage.threads));
      if (sampled.openSurfaces > 0)
      {
        vtkWarningMacro(<< sampled.openSurfaces
                        << " surfaces are not closed, outward 2-manifolds; what they fill is not to be relied on");
      }
      auto* output = vtkImageData::GetData(outputs);
      cactus::setGrid(output, gridOf(sampled.voxels));
      fillFractions(output->GetPointData(), sampled);
      fillLabels(output->GetPointData(), sampled);
      fillOrientations(output->GetPointData(), sampled);
      output->GetPointData()->SetActiveScalars("AVF");
      cactus::setDomain(output, substrate.domain);
      const auto provenance = cactus::recordOf(this, "SubstrateSampler", stage, { "Outer", "Inner", "Fibres" });
      cactus::setProvenance(output, provenance, 0);
    });
}
