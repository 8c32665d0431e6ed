// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBundleInitializer.h"

#include "FibreData.h"
#include "FilterSupport.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "bundle/BundleInitializer.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkBundleInitializer);

namespace
{

/// The radii of a table given as text or as a file.
std::vector<double> radiusTable(const char* text, const char* file)
{
  std::vector<double> listed = cactus::parseRadiusTable(text != nullptr ? text : "");
  if (file == nullptr || *file == '\0')
  {
    return listed;
  }
  if (!listed.empty())
  {
    throw cactus::InvalidInput("RadiusTable and RadiusTableFile are both given: clear one of them");
  }
  return cactus::readRadiusTable(file);
}

} // namespace

vtkBundleInitializer::vtkBundleInitializer()
{
  this->SetNumberOfInputPorts(0);
}

vtkBundleInitializer::~vtkBundleInitializer()
{
  this->SetRadiusTable(nullptr);
  this->SetRadiusTableFile(nullptr);
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
      cactus::BundleInitializerOptions options;
      options.side = this->Side;
      options.fibreVolumeFraction = this->FibreVolumeFraction;
      options.grownFibreVolumeFraction = this->GrownFibreVolumeFraction;
      options.radius.model = static_cast<cactus::RadiusModel>(this->RadiusDistribution);
      options.radius.gammaShape = this->GammaShape;
      options.radius.gammaScale = this->GammaScale;
      options.radius.lognormalMean = this->LognormalMean;
      options.radius.lognormalDeviation = this->LognormalDeviation;
      if (this->RadiusDistribution == TABLE)
      {
        options.radius.table = radiusTable(this->RadiusTable, this->RadiusTableFile);
      }
      options.radius.minimum = this->MinimumRadius;
      options.radius.maximum = this->MaximumRadius;
      options.meanDispersion = this->MeanDispersion;
      options.dispersionModel = static_cast<cactus::DispersionModel>(this->DispersionModel);
      options.correlationLength = this->CorrelationLength;
      options.numberOfBundles = this->NumberOfBundles;
      options.crossingAngle = this->CrossingAngle;
      options.crossingStyle = static_cast<cactus::CrossingStyle>(this->CrossingStyle);
      options.sheetThickness = this->SheetThickness;
      options.margin = this->Margin;
      options.spacingFactor = this->SpacingFactor;
      options.minimumSpacing = this->MinimumSpacing;
      options.maximumSpacing = this->MaximumSpacing;
      options.seed = cactus::seedFrom(this->Seed);

      cactus::BundleInitializerReport report;
      const cactus::Fibres fibres = cactus::initialiseBundles(options, cactus::contextFor(this), &report);
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(fibres, output);
      cactus::TextStream parameters;
      parameters.precision(6);
      parameters << options.describe() << " reached: Fibres=" << fibres.size()
                 << " FibreVolumeFraction=" << report.fibreVolumeFraction << " MeanDispersion=" << report.meanDispersion;
      cactus::addProvenance(nullptr, output, "BundleInitializer", parameters.str());
    });
}

void vtkBundleInitializer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Side: " << this->Side << '\n';
  os << indent << "FibreVolumeFraction: " << this->FibreVolumeFraction << '\n';
  os << indent << "GrownFibreVolumeFraction: " << this->GrownFibreVolumeFraction << '\n';
  os << indent << "RadiusDistribution: " << this->RadiusDistribution << '\n';
  os << indent << "GammaShape: " << this->GammaShape << '\n';
  os << indent << "GammaScale: " << this->GammaScale << '\n';
  os << indent << "LognormalMean: " << this->LognormalMean << '\n';
  os << indent << "LognormalDeviation: " << this->LognormalDeviation << '\n';
  os << indent << "RadiusTable: " << (this->RadiusTable ? this->RadiusTable : "(none)") << '\n';
  os << indent << "RadiusTableFile: " << (this->RadiusTableFile ? this->RadiusTableFile : "(none)") << '\n';
  os << indent << "MinimumRadius: " << this->MinimumRadius << '\n';
  os << indent << "MaximumRadius: " << this->MaximumRadius << '\n';
  os << indent << "MeanDispersion: " << this->MeanDispersion << '\n';
  os << indent << "DispersionModel: " << this->DispersionModel << '\n';
  os << indent << "CorrelationLength: " << this->CorrelationLength << '\n';
  os << indent << "NumberOfBundles: " << this->NumberOfBundles << '\n';
  os << indent << "CrossingAngle: " << this->CrossingAngle << '\n';
  os << indent << "CrossingStyle: " << this->CrossingStyle << '\n';
  os << indent << "SheetThickness: " << this->SheetThickness << '\n';
  os << indent << "Margin: " << this->Margin << '\n';
  os << indent << "SpacingFactor: " << this->SpacingFactor << '\n';
  os << indent << "MinimumSpacing: " << this->MinimumSpacing << '\n';
  os << indent << "MaximumSpacing: " << this->MaximumSpacing << '\n';
  os << indent << "Seed: " << this->Seed << '\n';
}
