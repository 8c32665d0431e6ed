// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBundleInitializer.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "NiftiFile.h"
#include "StageProperties.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "bundle/BundleInitializer.h"
#include "stages/StageWork.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkBundleInitializer);

namespace
{

/// Returns the numbers of OrientationVoxel, of which those of a peak that is none are 0.
std::vector<double> orientationOf(const cactus::BundleInitializerStage& stage)
{
  std::array<std::size_t, 3> voxel{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double number = stage.orientationVoxel[Eigen::Index(axis)];
    if (!(number >= 0.0 && number <= 1e6 && number == std::floor(number)))
    {
      throw cactus::InvalidInput(cactus::text("OrientationVoxel has ", number, ": give whole numbers from 0"));
    }
    voxel[axis] = static_cast<std::size_t>(number);
  }
  std::vector<double> values = cactus::NiftiFile(stage.orientationFile).voxel(voxel);
  for (std::size_t i = 0; stage.options.dispersionModel == cactus::DispersionModel::Peaks && i + 3 <= values.size(); i += 3)
  {
    if (std::isnan(values[i]) && std::isnan(values[i + 1]) && std::isnan(values[i + 2]))
    {
      std::fill_n(values.begin() + std::ptrdiff_t(i), 3, 0.0);
    }
  }
  if (std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; }))
  {
    throw cactus::InvalidInput(cactus::text(
      "voxel ", voxel[0], ' ', voxel[1], ' ', voxel[2], " of OrientationFile ", stage.orientationFile, " has no directions"));
  }
  return values;
}

/// Puts what OrientationFile holds in place of the file, so that records keep the numbers.
cactus::BundleInitializerStage withOrientation(cactus::BundleInitializerStage stage)
{
  if (!stage.options.isAnywhere() || stage.orientationFile.empty())
  {
    return stage;
  }
  const bool isPeaks = stage.options.dispersionModel == cactus::DispersionModel::Peaks;
  std::string& text = isPeaks ? stage.orientationPeaks : stage.orientationHarmonics;
  if (!text.empty())
  {
    throw cactus::InvalidInput(std::string(isPeaks ? "OrientationPeaks" : "OrientationHarmonics") +
                               " and OrientationFile are both given: clear one of them");
  }
  for (const double value : orientationOf(stage))
  {
    text += (text.empty() ? "" : " ") + cactus::exactText(value);
  }
  stage.orientationFile.clear();
  return stage;
}

} // namespace

vtkBundleInitializer::vtkBundleInitializer()
  : Properties(cactus::makeProperties<cactus::BundleInitializerStage>())
{
  this->SetNumberOfInputPorts(0);
}

int vtkBundleInitializer::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& asked = cactus::stageOf<cactus::BundleInitializerStage>(this->Properties);
      cactus::validateProperties(asked);
      const cactus::BundleInitializerStage stage = withOrientation(asked);
      const cactus::BundleInitializerOptions options = cactus::bundleOptions(stage);

      cactus::BundleInitializerReport report;
      const cactus::Fibres fibres = cactus::initialiseBundles(options, cactus::contextFor(this), &report);
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(fibres, output);
      const cactus::StageRecord record = cactus::bundleRecord(stage, options, fibres.size(), report);
      cactus::setProvenance(output, cactus::provenanceOf(record), 0);
      const std::string remarks = cactus::remarksOnBundle(options, report);
      if (!remarks.empty())
      {
        vtkWarningMacro(<< remarks);
      }
    });
}
