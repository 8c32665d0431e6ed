// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBundleInitializer.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "bundle/BundleInitializer.h"
#include "stages/Stages.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkBundleInitializer);

namespace
{

/// The options, with the radii of a table that is given as text or as a file.
cactus::BundleInitializerOptions optionsFrom(const cactus::BundleInitializerStage& stage)
{
  cactus::BundleInitializerOptions options = stage.options;
  if (options.radius.model != cactus::RadiusModel::Table)
  {
    return options;
  }
  options.radius.table = cactus::parseRadiusTable(stage.radiusTable);
  if (!stage.radiusTableFile.empty())
  {
    if (!options.radius.table.empty())
    {
      throw cactus::InvalidInput("RadiusTable and RadiusTableFile are both given: clear one of them");
    }
    options.radius.table = cactus::readRadiusTable(stage.radiusTableFile);
  }
  return options;
}

/// What was asked for and reached. A table of radii is kept as numbers, a file of them by its name and checksum.
cactus::Provenance recordOf(const cactus::BundleInitializerStage& stage, const cactus::BundleInitializerOptions& options,
  std::size_t fibres, const cactus::BundleInitializerReport& report)
{
  cactus::StageRecord record;
  record.filter = "BundleInitializer";
  record.properties = cactus::BundleInitializerStage::properties().states(stage);
  for (cactus::PropertyState& state : record.properties)
  {
    if (state.facts->name == "RadiusTable" && stage.radiusTableFile.empty())
    {
      state.value = options.radius.table;
    }
  }
  if (options.radius.model == cactus::RadiusModel::Table && !stage.radiusTableFile.empty())
  {
    record.files.push_back({ "RadiusTableFile", stage.radiusTableFile });
  }
  record.reached = { { "Fibres", static_cast<std::int64_t>(fibres) }, { "FibreVolumeFraction", report.fibreVolumeFraction },
    { "MeanDispersion", report.meanDispersion } };
  return cactus::provenanceOf(record);
}

} // namespace

vtkBundleInitializer::vtkBundleInitializer()
  : Properties(cactus::makeProperties<cactus::BundleInitializerStage>())
{
  this->SetNumberOfInputPorts(0);
}

int vtkBundleInitializer::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time)
{
  return cactus::pipelineTime(this, time);
}

int vtkBundleInitializer::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::BundleInitializerStage>(this->Properties);
      cactus::validateProperties(stage);
      const cactus::BundleInitializerOptions options = optionsFrom(stage);

      cactus::BundleInitializerReport report;
      const cactus::Fibres fibres = cactus::initialiseBundles(options, cactus::contextFor(this), &report);
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(fibres, output);
      cactus::setProvenance(output, recordOf(stage, options, fibres.size(), report), 0);
    });
}

void vtkBundleInitializer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties->print(os, indent);
}
