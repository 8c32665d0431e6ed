// SPDX-License-Identifier: BSD-3-Clause
#include "stages/StageWork.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Numbers.h"
#include "bundle/RadiusColumn.h"
#include "fibres/TrimToDomain.h"
#include "io/FileCollection.h"
#include "io/OpenSurfaces.h"
#include "io/TractogramFile.h"
#include "optimiser/OverlapReport.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <string_view>

namespace cactus
{

namespace
{

/// Well above the overlaps that the optimiser leaves (OverlapTolerance, 0.001), and above the digits of a file.
constexpr double harmlessPenetration = 0.01;

/// The relative increase of all fibres' length. Bundles whose neighbours run alike stay below 0.01, those of independent
/// directions up to 15° below this.
constexpr double harmlessLengthIncrease = 0.08;

/// For the record.
const char* reasonName(StopReason reason)
{
  switch (reason)
  {
  case StopReason::MaximumIterations:
    return "MaximumIterations";
  case StopReason::Stagnated:
    return "Stagnated";
  case StopReason::TimeBudget:
    return "TimeBudget";
  case StopReason::Stopped:
    return "Stopped";
  default:
    return "Converged";
  }
}

const char* reasonText(StopReason reason)
{
  switch (reason)
  {
  case StopReason::MaximumIterations:
    return "MaximumIterations were used up";
  case StopReason::Stagnated:
    return "nothing more was gained";
  case StopReason::TimeBudget:
    return "TimeBudget ran out";
  case StopReason::Stopped:
    return "the run was stopped";
  default:
    return "converged";
  }
}

/// A longer first step of Adagrad (µm) jumps over its contacts.
constexpr double longAdagradStep = 0.2;

/// Returns advice on the overlaps that a run has left; nothing if the user ended it.
std::string adviceOn(StopReason reason, const CapsuleOptimizerOptions& options)
{
  if (reason == StopReason::Stagnated && options.method == DescentMethod::Adagrad && options.stepSize > longAdagradStep)
  {
    return text(" StepSize ", options.stepSize, " is the first step in µm with Adagrad: about 0.02 is usual.");
  }
  switch (reason)
  {
  case StopReason::MaximumIterations:
    return " Allow more MaximumIterations, or ask for a lower density.";
  case StopReason::TimeBudget:
    return " Allow a longer TimeBudget, or go on from a CheckpointFile by Resume.";
  case StopReason::Stopped:
    return "";
  default:
    return " Ask for a lower density, or for less dispersion; fibres that were not made here need more room: thinner ones, or a "
           "RadiusTolerance above 0.";
  }
}

/// Records the table of radii: the numbers, or for a file its name and checksum.
void keepRadiusTable(const RadiusDistributionOptions& radius, const std::string& path, StageRecord& record)
{
  for (PropertyState& state : record.properties)
  {
    if (state.facts->name == "RadiusTable" && path.empty())
    {
      state.value = radius.table;
    }
  }
  if (radius.model == RadiusModel::Table && !path.empty())
  {
    record.files.push_back({ "RadiusTableFile", path });
  }
}

/// Returns a bundle for each streamline, from the file's values of that name or from its groups; none if it has neither.
std::vector<int> bundlesOf(const Tractogram& tractogram)
{
  constexpr char name[] = "BundleId";
  const TractogramValues* values = valuesNamed(tractogram.streamlineValues, name);
  if (values == nullptr)
  {
    return bundlesByGroup(tractogram);
  }
  if (values->components != 1)
  {
    throw InvalidInput(text("array BundleId must have one component and ", tractogram.size(), " values"));
  }
  std::vector<int> bundles;
  for (const double value : values->values)
  {
    if (!limits::id.holds(value) || value != std::floor(value))
    {
      throw InvalidInput(text("BundleId of streamline ", bundles.size() + 1, " is ", value, ": ids are whole numbers from 1 on"));
    }
    bundles.push_back(static_cast<int>(value));
  }
  return bundles;
}

/// Returns the distribution with the stage's table.
template <typename Stage>
RadiusDistributionOptions withTableOf(const Stage& stage)
{
  const bool isTable = stage.options.radius.model == RadiusModel::Table && !stage.radiusTableFile.empty();
  if (isTable)
  {
    validateProperties(stage);
  }
  RadiusDistributionOptions radius = stage.options.radius;
  if (isTable && stage.radiusTable.empty() && !stage.radiusTableColumn.empty())
  {
    radius.table = readRadiusColumn(stage.radiusTableFile, stage.radiusTableColumn);
  }
  else
  {
    radius = withTable(radius, stage.radiusTable, stage.radiusTableFile);
  }
  for (double& value : radius.table)
  {
    value *= isTable ? stage.radiusTableFactor : 1.0;
  }
  return radius;
}

/// Tells whether angles have Watson's distribution.
bool hasKappa(DispersionModel model)
{
  return model == DispersionModel::Watson || model == DispersionModel::Coherent || model == DispersionModel::Peaks;
}

/// Returns the mean angle (degrees) that a stage asks for, as an angle, κ or ODI.
double meanDispersionOf(const BundleInitializerStage& stage)
{
  const bool isGiven = stage.watsonKappa != 0.0 || stage.odi != 0.0;
  if (!isGiven)
  {
    return stage.options.meanDispersion;
  }
  validateProperties(stage);
  if (!hasKappa(stage.options.dispersionModel))
  {
    throw InvalidInput("WatsonKappa and ODI are for DispersionModel Watson, Coherent and Peaks: set both to 0");
  }
  if (stage.watsonKappa != 0.0 && stage.odi != 0.0)
  {
    throw InvalidInput("WatsonKappa and ODI are both given: set one of them to 0");
  }
  const double angle = watsonMeanAngle(stage.odi != 0.0 ? kappaOfOdi(stage.odi) : stage.watsonKappa);
  if (angle > limits::meanDispersion.highest)
  {
    throw InvalidInput(text(stage.odi != 0.0 ? "ODI" : "WatsonKappa", " gives a mean angle of ", angle, "°: it can be at most ",
      limits::meanDispersion.highest, "°; for more, use DispersionModel Harmonics"));
  }
  return angle;
}

/// Returns the numbers of a text.
std::vector<double> numbersOf(const char* name, std::string_view text)
{
  std::vector<double> numbers;
  if (!takeNumbers(text, numbers))
  {
    throw InvalidInput(std::string(name) + " holds \"" + excerpt(text) + "\", which is no number");
  }
  return numbers;
}

} // namespace

BundleInitializerOptions bundleOptions(const BundleInitializerStage& stage)
{
  BundleInitializerOptions options = stage.options;
  options.radius = withTableOf(stage);
  options.meanDispersion = meanDispersionOf(stage);
  if (!options.isAnywhere())
  {
    return options;
  }
  if (!stage.orientationFile.empty())
  {
    throw InvalidInput("OrientationFile is read by ParaView's filter alone: give the voxel's numbers as OrientationHarmonics or "
                       "OrientationPeaks");
  }
  if (options.dispersionModel == DispersionModel::Harmonics)
  {
    options.harmonics = numbersOf("OrientationHarmonics", stage.orientationHarmonics);
    return options;
  }
  const std::vector<double> peaks = numbersOf("OrientationPeaks", stage.orientationPeaks);
  if (peaks.size() % 3 != 0)
  {
    throw InvalidInput(text("OrientationPeaks has ", peaks.size(), " numbers: give three, x, y and z, for each bundle"));
  }
  for (std::size_t i = 0; i < peaks.size(); i += 3)
  {
    options.peaks.emplace_back(peaks[i], peaks[i + 1], peaks[i + 2]);
  }
  return options;
}

StageRecord bundleRecord(const BundleInitializerStage& stage, const BundleInitializerOptions& options, std::size_t fibres,
  const BundleInitializerReport& report)
{
  StageRecord record;
  record.filter = "BundleInitializer";
  record.properties = BundleInitializerStage::properties().states(stage);
  keepRadiusTable(options.radius, stage.radiusTableFile, record);
  record.reached = { { "Fibres", static_cast<std::int64_t>(fibres) }, { "FibreVolumeFraction", report.fibreVolumeFraction },
    { "MeanDispersion", report.meanDispersion } };
  if (hasKappa(options.dispersionModel) && report.meanDispersion > 0.0)
  {
    const double kappa = watsonKappa(report.meanDispersion);
    record.reached.push_back({ "WatsonKappa", kappa });
    record.reached.push_back({ "ODI", odiOfKappa(kappa) });
  }
  if (isStationary(options))
  {
    record.reached.push_back({ "Sinuosity", report.sinuosity });
  }
  return record;
}

std::string remarksOnBundle(const BundleInitializerOptions& options, const BundleInitializerReport& report)
{
  constexpr double tolerance = 0.005;
  constexpr double relativeTolerance = 0.05;
  const auto rounded = [](double value) { return std::round(1000.0 * value) / 1000.0; };
  std::string told;
  if (std::abs(report.fibreVolumeFraction - options.fibreVolumeFraction) > relativeTolerance * options.fibreVolumeFraction)
  {
    told = text("FibreVolumeFraction is ", rounded(report.fibreVolumeFraction), " where ", options.fibreVolumeFraction,
      " was asked for: so small a domain holds more or less by chance. Enlarge Side, lower MaximumRadius, or try another Seed");
  }
  if (isStationary(options) && std::abs(report.sinuosity - options.sinuosity) > tolerance)
  {
    told += text(told.empty() ? "" : "; ", "Sinuosity is ", rounded(report.sinuosity), " where ", options.sinuosity,
      " was asked for: fibres of so large a MeanDispersion that run alike with neighbours over so short a CorrelationLength wind "
      "more. Lower MeanDispersion, or enlarge CorrelationLength or Sinuosity");
  }
  constexpr std::size_t fewLayers = 3;
  if (options.isLayered() && options.crossingStyle == CrossingStyle::Interwoven && report.layers <= fewLayers)
  {
    told += text(told.empty() ? "" : "; ", "the bundles lie in ", report.layers,
      " layers, which is too few to be interwoven: a fibre as thick as these takes much of so low a domain. Enlarge Side, lower "
      "MaximumRadius, or use Mixing Interpenetrating");
  }
  constexpr double roomForThin = 0.8;
  if (options.unmyelinated.any() && options.calibre.varies() && options.grownFibreVolumeFraction > roomForThin)
  {
    told += text(told.empty() ? "" : "; ",
      "axons without myelin will end thicker than asked for, since thick fibres that swell "
      "leave them no place where all fill more than ",
      roomForThin, ", and growth fills what is left: choose ",
      options.calibre.model == CalibreModel::Beads ? "BeadAmplitude" : "CalibreVariation",
      " 0, or a GrownFibreVolumeFraction of ", roomForThin, " or less");
  }
  return told;
}

CurvedBundlesOptions curvedOptions(const CurvedBundlesStage& stage)
{
  CurvedBundlesOptions options = stage.options;
  options.radius = withTableOf(stage);
  return options;
}

StageRecord curvedRecord(
  const CurvedBundlesStage& stage, const CurvedBundlesOptions& options, std::size_t fibres, double fibreVolumeFraction)
{
  StageRecord record;
  record.filter = "CurvedBundles";
  record.properties = CurvedBundlesStage::properties().states(stage);
  keepRadiusTable(options.radius, stage.radiusTableFile, record);
  record.reached = { { "Fibres", static_cast<std::int64_t>(fibres) }, { "FibreVolumeFraction", fibreVolumeFraction } };
  return record;
}

TractFibresOptions tractOptions(const TractFibresStage& stage)
{
  TractFibresOptions options = stage.options;
  options.radius = withTableOf(stage);
  return options;
}

StageRecord tractRecord(
  const TractFibresStage& stage, const TractFibresOptions& options, std::size_t fibres, const TractFibresReport& report)
{
  StageRecord record;
  record.filter = "TractFibres";
  record.properties = TractFibresStage::properties().states(stage);
  keepRadiusTable(options.radius, stage.radiusTableFile, record);
  record.reached = { { "Fibres", static_cast<std::int64_t>(fibres) },
    { "Streamlines", static_cast<std::int64_t>(report.streamlines) }, { "FibreVolumeFraction", report.fibreVolumeFraction },
    { "BundleDiameter", report.bundleDiameter }, { "Smoothing", report.smoothing },
    { "Middle", std::vector<double>(report.middle.data(), report.middle.data() + 3) } };
  return record;
}

Tractogram tractogramOf(const TractogramReaderStage& stage, const Context& context)
{
  if (stage.fileName.empty())
  {
    throw InvalidInput("FileName is empty: name the tractogram to read");
  }
  Tractogram tractogram = readTractogram(stage.fileName, context);
  setLengths(tractogram, stage.lengthUnit, stage.radius);
  return tractogram;
}

StageRecord tractogramRecord(const TractogramReaderStage& stage)
{
  StageRecord record;
  record.filter = "TractogramReader";
  record.properties = TractogramReaderStage::properties().states(stage);
  std::error_code error;
  if (!std::filesystem::is_directory(stage.fileName, error))
  {
    record.files.push_back({ "FileName", stage.fileName });
    return record;
  }
  for (const std::string& name : Folder(stage.fileName).names())
  {
    record.files.push_back({ "FileName", (std::filesystem::path(stage.fileName) / name).string() });
  }
  return record;
}

Streamlines streamlinesOf(const std::vector<const Tractogram*>& tractograms)
{
  Streamlines all;
  bool haveBundles = true;
  for (const Tractogram* tractogram : tractograms)
  {
    const std::vector<int> bundles = bundlesOf(*tractogram);
    haveBundles = haveBundles && bundles.size() == tractogram->size();
    all.bundleIds.insert(all.bundleIds.end(), bundles.begin(), bundles.end());
    const std::size_t before = all.points.size();
    all.points.reserve(before + tractogram->pointCount());
    for (std::size_t p = 0; p < tractogram->pointCount(); ++p)
    {
      all.points.emplace_back(tractogram->points.data() + 3 * p);
    }
    for (std::size_t s = 1; s < tractogram->offsets.size(); ++s)
    {
      all.offsets.push_back(before + tractogram->offsets[s]);
    }
  }
  if (!haveBundles)
  {
    all.bundleIds.clear();
  }
  validate(all);
  return all;
}

std::string remarksOnTract(const TractFibresReport& report)
{
  std::string told;
  if (report.smoothing > 0.0)
  {
    told = text("bends sharper than a bundle of ", report.bundleDiameter, " µm can follow were rounded off (by a Gaussian of ",
      report.smoothing, " µm); a smaller BundleDiameter follows them");
  }
  if (report.ends > 0)
  {
    told +=
      text(told.empty() ? "" : "; ", report.ends, report.ends == 1 ? " end of a streamline lies" : " ends of streamlines lie",
        " in the domain, from where the fibres run on straight");
  }
  return told;
}

FibresOfFile strandsOf(const StrandReaderStage& stage)
{
  if (stage.fileName.empty())
  {
    throw InvalidInput("FileName is empty: name the strand file to read");
  }
  return readFibreFile(stage.fileName);
}

StageRecord strandRecord(const StrandReaderStage& stage)
{
  StageRecord record;
  record.filter = "StrandReader";
  record.properties = StrandReaderStage::properties().states(stage);
  record.files.push_back({ "FileName", stage.fileName });
  return record;
}

StageRecord niftiRecord(const NiftiReaderStage& stage)
{
  StageRecord record;
  record.filter = "NiftiReader";
  record.properties = NiftiReaderStage::properties().states(stage);
  record.files.push_back({ "FileName", stage.fileName });
  return record;
}

std::vector<std::pair<std::string, PropertyValue>> optimiserReached(
  int iterations, double penetration, StopReason reason, bool isResult)
{
  return { { "Iterations", std::int64_t(iterations) }, { "MaximumPenetration", penetration },
    { "Ended", std::string(reasonName(reason)) }, { "IsResult", isResult } };
}

std::vector<std::pair<std::string, PropertyValue>> growthReached(double spacing, const SolvedGrowth& growth)
{
  std::vector<std::pair<std::string, PropertyValue>> reached{ { "Spacing", spacing }, { "Growth", growth.growth } };
  if (growth.fraction > 0.0)
  {
    reached.emplace_back("FibreVolumeFraction", growth.fraction);
  }
  return reached;
}

Fibres trimmedFibres(const CapsuleOptimizerStage& stage, Fibres fibres, std::vector<std::size_t>& kept)
{
  kept.resize(fibres.points.size());
  std::iota(kept.begin(), kept.end(), std::size_t(0));
  if (stage.trimToDomain)
  {
    fibres = trimToDomain(fibres, &kept);
  }
  if (fibres.size() == 0)
  {
    throw InvalidInput("no fibre comes near the Domain: check its position, or switch TrimToDomain off");
  }
  return fibres;
}

std::string remarkOnCheckpoint(const OptimisationResult& result)
{
  return result.checkpointFailure.empty() ? "" : "the run could not be written down to go on from: " + result.checkpointFailure;
}

std::vector<std::string> remarksOnOptimisation(const OptimisationResult& result, const CapsuleOptimizerOptions& options)
{
  std::vector<std::string> remarks;
  if (const std::string remark = remarkOnCheckpoint(result); !remark.empty())
  {
    remarks.push_back(remark);
  }
  if (const Resampling& done = result.resampling; done.fibres > 0)
  {
    remarks.push_back(text(done.fibres, done.fibres == 1 ? " fibre has" : " fibres have",
      " control points closer together than half the radius, which would fold up, and ", done.fibres == 1 ? "was" : "were",
      " resampled: no point that came in lies further than ", done.largestDeviation, " µm from the new polyline."));
  }
  if (result.maximumPenetration > options.overlapTolerance)
  {
    remarks.push_back(text("overlaps remain: ", reasonText(result.reason), " after ", result.convergence.back().iteration,
      " iterations with ", result.overlappingPairs, " capsule pairs above OverlapTolerance ", options.overlapTolerance,
      ", the largest penetration being ", result.maximumPenetration, ". The best state is kept.",
      adviceOn(result.reason, options)));
  }
  else if (result.lengthIncrease > harmlessLengthIncrease)
  {
    remarks.push_back(text("the fibres have become ", std::lround(100.0 * result.lengthIncrease),
      " % longer (LengthIncrease), since they wind around each other where there is no straighter way. A larger ",
      "LengthWeight or a Relaxation nearer to 1 keeps them straighter. Where the bundle is made, so do less dispersion, ",
      "DispersionModel Coherent and a lower density; fibres that were not made here may have radii too large for their ",
      "centre lines."));
  }
  return remarks;
}

std::string remarkOnOverlaps(const Fibres& fibres, int threads)
{
  const OverlapReport report = measureOverlap(fibres, harmlessPenetration, threads);
  if (report.overlappingPairs == 0)
  {
    return {};
  }
  return text(report.overlappingPairs, " pairs of capsules of different fibres overlap, the worst by ",
    std::lround(100.0 * report.largestPenetration),
    " % of their radii, and take space from each other: the optimiser has not parted these fibres. Apply CapsuleOptimizer first, "
    "and grow what it gives");
}

void setWriterOptions(const SubstrateWriterStage& stage, SubstrateFolderContents& contents)
{
  contents.format = stage.format;
  contents.encoding = stage.encoding;
  contents.mcdc.permeability = stage.permeability;
  contents.voxelSize = stage.voxelSize;
  contents.startPositions = stage.startPositions;
  contents.seed = stage.seed;
  contents.periodicFaces = facesFor(stage.periodicFaces, stage.format, contents.domain, stage.allowOpenSurfaces);
  contents.allowOpenSurfaces = stage.allowOpenSurfaces;
  contents.certificate.minimumGap = stage.minimumGap;
}

ProductionOrder productionOrder(
  const SubstrateProductionStage& stage, std::function<Provenance(double spacing, const SolvedGrowth& growth)> provenance)
{
  ProductionOrder order;
  order.growth = stage.growth;
  order.growth.seed = stage.surfaces.seed;
  order.surfaces = stage.surfaces;
  order.format = stage.format;
  order.encoding = stage.encoding;
  order.periodicFaces = stage.periodicFaces;
  order.allowOpenSurfaces = stage.allowOpenSurfaces;
  order.sampledFraction = stage.sampledFraction;
  order.provenance = std::move(provenance);
  return order;
}

} // namespace cactus
