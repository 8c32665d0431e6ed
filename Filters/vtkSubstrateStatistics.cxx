// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubstrateStatistics.h"

#include "Columns.h"
#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "SubstrateInputs.h"
#include "SurfaceData.h"
#include "WholeData.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Numbers.h"
#include "judge/SubstrateStatistics.h"
#include "stages/Stages.h"

#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <algorithm>
#include <cmath>
#include <string>

vtkStandardNewMacro(vtkSubstrateStatistics);

namespace
{

using cactus::addColumn;

void fillSubstrate(vtkTable* table, const cactus::SubstrateStatistics& s)
{
  const auto number = [&](const char* name, double value)
  { addColumn<vtkDoubleArray>(table, name, 1, [value](std::size_t) { return value; }); };
  const auto count = [&](const char* name, std::size_t value)
  { addColumn<vtkIdTypeArray>(table, name, 1, [value](std::size_t) { return value; }); };
  count("Fibres", s.fibres.size());
  number("FVF", s.fibreVolumeFraction);
  number("AVF", s.axonVolumeFraction);
  number("MVF", s.myelinVolumeFraction);
  number("UnmyelinatedFraction", s.unmyelinatedFraction);
  number("AxonalWaterFraction", s.axonalWaterFraction);
  number("AggregateGRatio", s.aggregateGRatio);
  number("CapsuleVolumeFraction", s.capsuleVolumeFraction);
  number("LargestPenetration", s.largestPenetration);
  number("MeanDispersion_deg", s.meanDispersion);
  number("TangentDispersion_deg", s.tangentDispersion);
  number("OrientationP2", s.directions.p2);
  number("OrientationP2ByAxonVolume", s.directions.p2ByAxonVolume);
  number("WatsonKappa", s.directions.kappa);
  number("ODI", s.directions.odi);
  number("LocalSpread_deg", s.directions.localSpread);
  number("Twist", s.directions.twist);
  number("AzimuthRatio", s.directions.azimuthRatio);
  number("AngularCorrelation", s.directions.angularCorrelation);
  number("MeanTargetRadius_um", s.meanTargetRadius);
  number("MeanOuterRadius_um", s.meanOuterRadius);
  number("MeanInnerRadius_um", s.meanInnerRadius);
  count("OuterClosed", s.outerClosed);
  count("OuterOpen", s.outerOpen);
  count("InnerClosed", s.innerClosed);
  count("InnerOpen", s.innerOpen);
  count("Triangles", s.triangles);
  number("TrianglesPerArea_um-2", s.trianglesPerArea);
  number("SmallestAngle_deg", s.smallestAngle);
  number("LargestSquaredEdgeRatio", s.largestSquaredEdgeRatio);
  number("MeanSinuosity", s.meanSinuosity);
  number("MeanUndulation_um", s.meanUndulation);
  number("MeanOuterAxisRatio", s.meanOuterAxisRatio);
  number("MeanInnerAxisRatio", s.meanInnerAxisRatio);
  number("MeanOuterCalibreVariation", s.meanOuterCalibreVariation);
  number("MeanInnerCalibreVariation", s.meanInnerCalibreVariation);
  number("MeanAxonDiffusivityRatio", s.meanDiffusivityRatio);
  number("MeanAxonAreaFluctuation_um", s.meanAreaFluctuation);
  number("MeanBeadAmplitude", s.meanBeadAmplitude);
  number("MeanBeadSpacing_um", s.meanBeadSpacing);
  number("EffectiveRadius_um", s.effectiveRadius);
  number("MiddleEffectiveRadius_um", s.middleEffectiveRadius);
  number("IntraAxonalSurfaceToVolume_um-1", s.intraSurfaceToVolume);
  number("ExtraAxonalSurfaceToVolume_um-1", s.extraSurfaceToVolume);
  number("ExtraAxonalDiffusivityRatioX", s.outside.ratio[0]);
  number("ExtraAxonalDiffusivityRatioY", s.outside.ratio[1]);
  number("ExtraAxonalDiffusivityRatioZ", s.outside.ratio[2]);
  number("ExtraAxonalDiffusivityErrorX", s.outside.standardError[0]);
  number("ExtraAxonalDiffusivityErrorY", s.outside.standardError[1]);
  number("ExtraAxonalDiffusivityErrorZ", s.outside.standardError[2]);
}

/// Turns a table of one row into readable lines: ParaView's spreadsheets sort columns by name, but not rows. Numbers have six
/// digits, counts all; missing values are "-".
void fillSummary(vtkTable* table, vtkTable* whole)
{
  const auto columns = static_cast<std::size_t>(whole->GetNumberOfColumns());
  const auto column = [whole](std::size_t row) { return whole->GetColumn(static_cast<vtkIdType>(row)); };
  const auto valueOf = [&](std::size_t row)
  {
    const double value = whole->GetValue(0, static_cast<vtkIdType>(row)).ToDouble();
    std::string text = std::isnan(value) ? "-" : "";
    if (!std::isnan(value))
    {
      cactus::appendNumber(text, value, column(row)->IsA("vtkIdTypeArray") != 0 ? 15 : 6);
    }
    return text;
  };
  addColumn<vtkStringArray>(table, "Quantity", columns, [&](std::size_t row) { return std::string(column(row)->GetName()); });
  addColumn<vtkStringArray>(table, "Value", columns, valueOf);
}

void fillFibres(vtkTable* table, const std::vector<cactus::FibreStatistics>& fibres)
{
  using Fibre = cactus::FibreStatistics;
  const auto number = [&](const char* name, double (*value)(const Fibre&))
  { addColumn<vtkDoubleArray>(table, name, fibres.size(), [&](std::size_t row) { return value(fibres[row]); }); };
  const auto integer = [&](const char* name, std::size_t (*value)(const Fibre&))
  { addColumn<vtkIntArray>(table, name, fibres.size(), [&](std::size_t row) { return value(fibres[row]); }); };
  const auto isClosed = [](const cactus::SurfaceReport& report) -> std::size_t
  { return report.closedManifold() && report.outward() ? 1 : 0; };
  integer("FibreId", [](const Fibre& f) { return static_cast<std::size_t>(f.fibreId); });
  integer("BundleId", [](const Fibre& f) { return static_cast<std::size_t>(f.bundleId); });
  number("TargetRadius_um", [](const Fibre& f) { return f.targetRadius; });
  number("OuterRadius_um", [](const Fibre& f) { return f.outerRadius.mean; });
  number("InnerRadius_um", [](const Fibre& f) { return f.innerRadius.mean; });
  number("OuterRadiusDeviation_um", [](const Fibre& f) { return f.outerRadius.deviation; });
  number("InnerRadiusDeviation_um", [](const Fibre& f) { return f.innerRadius.deviation; });
  number("OuterCircularity", [](const Fibre& f) { return f.outerRadius.circularity; });
  number("InnerCircularity", [](const Fibre& f) { return f.innerRadius.circularity; });
  number("OuterAxisRatio", [](const Fibre& f) { return f.outerRadius.axisRatio; });
  number("InnerAxisRatio", [](const Fibre& f) { return f.innerRadius.axisRatio; });
  number("GRatio", [](const Fibre& f) { return f.gRatio; });
  number("GRatioDeviation", [](const Fibre& f) { return f.gRatioDeviation(); });
  number("Length_um", [](const Fibre& f) { return f.length; });
  number("OuterVolume_um3", [](const Fibre& f) { return f.outer.volume; });
  number("InnerVolume_um3", [](const Fibre& f) { return f.inner.volume; });
  number("OuterArea_um2", [](const Fibre& f) { return f.outer.area; });
  number("InnerArea_um2", [](const Fibre& f) { return f.inner.area; });
  addColumn<vtkIntArray>(table, "OuterClosed", fibres.size(), [&](std::size_t row) { return isClosed(fibres[row].outer); });
  addColumn<vtkIntArray>(table, "InnerClosed", fibres.size(), [&](std::size_t row) { return isClosed(fibres[row].inner); });
  integer("OuterComponents", [](const Fibre& f) { return f.outer.components; });
  integer("InnerComponents", [](const Fibre& f) { return f.inner.components; });
  integer("OuterTriangles", [](const Fibre& f) { return f.outer.triangles; });
  integer("InnerTriangles", [](const Fibre& f) { return f.inner.triangles; });
  integer("OuterCuts", [](const Fibre& f) { return f.outerRadius.cuts; });
  integer("InnerCuts", [](const Fibre& f) { return f.innerRadius.cuts; });
  number("Sinuosity", [](const Fibre& f) { return f.line.sinuosity; });
  number("Undulation_um", [](const Fibre& f) { return f.line.undulation; });
  number("OuterCalibreVariation", [](const Fibre& f) { return f.outerCalibreVariation(); });
  number("InnerCalibreVariation", [](const Fibre& f) { return f.innerCalibreVariation(); });
  number("MeanInverseAxonArea_um-2", [](const Fibre& f) { return f.axon.meanInverseArea; });
  number("AxonAreaVariance", [](const Fibre& f) { return f.axon.areaVariance; });
  number("AxonAreaFluctuation_um", [](const Fibre& f) { return f.axon.areaFluctuation; });
  number("AxonDiffusivityRatio", [](const Fibre& f) { return f.axon.diffusivityRatio; });
  number("BeadAmplitude", [](const Fibre& f) { return f.axon.beadAmplitude; });
  number("BeadSpacing_um", [](const Fibre& f) { return f.axon.beadSpacing; });
  number("EffectiveRadius_um", [](const Fibre& f) { return f.axon.effectiveRadius; });
  number("AxonSurfaceToVolume_um-1", [](const Fibre& f) { return f.axonSurfaceToVolume(); });
}

void fillProfiles(vtkTable* table, const std::vector<cactus::ProfilePoint>& points)
{
  using Point = cactus::ProfilePoint;
  const auto number = [&](const char* name, double Point::*value)
  { addColumn<vtkDoubleArray>(table, name, points.size(), [&](std::size_t row) { return points[row].*value; }); };
  addColumn<vtkIntArray>(table, "FibreId", points.size(), [&](std::size_t row) { return points[row].fibreId; });
  number("ArcLength_um", &Point::arcLength);
  number("OuterDiameter_um", &Point::outerDiameter);
  number("InnerDiameter_um", &Point::innerDiameter);
  number("OuterCircularity", &Point::outerCircularity);
  number("InnerCircularity", &Point::innerCircularity);
  number("OuterAxisRatio", &Point::outerAxisRatio);
  number("InnerAxisRatio", &Point::innerAxisRatio);
  number("MyelinThickness_um", &Point::myelinThickness);
  number("GRatio", &Point::gRatio);
}

void fillHistograms(vtkTable* table, const std::vector<cactus::FibreStatistics>& fibres, std::size_t bins)
{
  std::vector<double> target;
  std::vector<double> outer;
  std::vector<double> inner;
  std::vector<double> gRatio;
  double largest = 0.0;
  for (const auto& fibre : fibres)
  {
    if (!(fibre.length > 0.0))
    {
      continue; // of those that only graze the domain there are more the thicker they are
    }
    target.push_back(fibre.targetRadius);
    outer.push_back(fibre.outerRadius.mean);
    inner.push_back(fibre.innerRadius.mean);
    gRatio.push_back(fibre.gRatio);
    largest = std::fmax(largest, std::fmax(fibre.targetRadius, std::fmax(fibre.outerRadius.mean, fibre.innerRadius.mean)));
  }
  // Up to a round number of tenths of a µm, so that bins have readable edges.
  const double upper = std::ceil(largest * 10.0) / 10.0;
  const auto edge = [bins](double last, std::size_t i) { return last * static_cast<double>(i) / static_cast<double>(bins); };
  const auto middle = [&](double last, std::size_t i) { return 0.5 * (edge(last, i) + edge(last, i + 1)); };
  const auto counts = [&](const char* name, const std::vector<double>& values, double last)
  {
    const auto count = cactus::histogram(values, 0.0, last, bins);
    addColumn<vtkIdTypeArray>(table, name, bins, [&](std::size_t row) { return count[row]; });
  };
  addColumn<vtkDoubleArray>(table, "RadiusFrom_um", bins, [&](std::size_t row) { return edge(upper, row); });
  addColumn<vtkDoubleArray>(table, "RadiusTo_um", bins, [&](std::size_t row) { return edge(upper, row + 1); });
  addColumn<vtkDoubleArray>(table, "RadiusMiddle_um", bins, [&](std::size_t row) { return middle(upper, row); });
  counts("TargetRadiusFibres", target, upper);
  counts("OuterRadiusFibres", outer, upper);
  counts("InnerRadiusFibres", inner, upper);
  addColumn<vtkDoubleArray>(table, "GRatioFrom", bins, [&](std::size_t row) { return edge(1.0, row); });
  addColumn<vtkDoubleArray>(table, "GRatioTo", bins, [&](std::size_t row) { return edge(1.0, row + 1); });
  addColumn<vtkDoubleArray>(table, "GRatioMiddle", bins, [&](std::size_t row) { return middle(1.0, row); });
  counts("GRatioFibres", gRatio, 1.0);
}

} // namespace

vtkSubstrateStatistics::vtkSubstrateStatistics()
  : Properties(cactus::makeProperties<cactus::SubstrateStatisticsStage>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(5);
}

int vtkSubstrateStatistics::FillInputPortInformation(int port, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port > 0 ? 1 : 0);
  return 1;
}

int vtkSubstrateStatistics::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 3);
  return 1;
}

int vtkSubstrateStatistics::RequestData(vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::SubstrateStatisticsStage>(this->Properties);
      cactus::validateProperties(stage);
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        return; // one rank measures; otherwise the tables of all ranks would be joined into rows that repeat
      }
      const cactus::SubstrateData data = cactus::measuredDataOf(this, 0, 1, 2);
      const cactus::Fibres fibres = cactus::fibresFrom(data.fibres);
      cactus::requireSameDomain(fibres.domain, data.outer, "Outer");
      cactus::requireSameDomain(fibres.domain, data.inner, "Inner");
      const cactus::FibreSurfaces outer = cactus::surfacesFrom(data.outer, "Outer", 0);
      const cactus::FibreSurfaces inner = cactus::surfacesFrom(data.inner, "Inner", 1);
      cactus::requireInnerOf(outer, inner);
      const auto statistics =
        cactus::measureSubstrate(fibres, outer, inner, stage.options, cactus::contextFor(this, stage.threads));
      if (statistics.outerOpen + statistics.innerOpen > 0)
      {
        vtkWarningMacro(<< statistics.outerOpen << " outer and " << statistics.innerOpen
                        << " inner surfaces are not closed, outward 2-manifolds; their volumes are not to be relied on");
      }
      fillSubstrate(vtkTable::GetData(outputs, 0), statistics);
      fillFibres(vtkTable::GetData(outputs, 1), statistics.fibres);
      fillHistograms(vtkTable::GetData(outputs, 2), statistics.fibres, static_cast<std::size_t>(stage.bins));
      fillProfiles(vtkTable::GetData(outputs, 3), cactus::profilesOf(statistics.fibres, stage.options.cutSpacing));
      fillSummary(vtkTable::GetData(outputs, 4), vtkTable::GetData(outputs, 0));
      const auto provenance = cactus::recordOf(this, "SubstrateStatistics", stage, { "Fibres", "Outer", "Inner" });
      for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
      {
        cactus::setProvenance(vtkTable::GetData(outputs, port), provenance, port);
      }
    });
}
