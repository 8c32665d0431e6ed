// SPDX-License-Identifier: BSD-3-Clause
#include "stages/Stages.h"

#include "base/Limits.h"
#include "io/SubstrateContents.h"

#include <iterator>

namespace cactus
{

namespace
{

constexpr char threadsMeaning[] = "Threads to use, on which no result depends; 0: all";

// Properties of writers.
const std::vector<std::string> formats(std::begin(formatNames), std::end(formatNames));
constexpr char formatMeaning[] = "The simulator that is to read the folder, or none";
const std::vector<std::string> encodingNames{ "ASCII", "Binary" };
constexpr char encodingMeaning[] =
  "Of PLY files that no simulator needs as text: text, or bytes, which take half the room; Binary is for Format RMS, "
  "Surfaces alone, SpinDoctor, Surfaces by bundle and MCMRSimulator, and refused for others";
constexpr char fileUnit[] =
  "Unit of the file's lengths. Readers take millimetres, whatever the header says; what is placed is always in them";
constexpr Range leastRadius{ 0.0, 1e3, " µm" };
constexpr Range tableFactor{ 1e-6, 1e6 };
constexpr Range partOfHits{ 0.0, 1.0 };
constexpr Range startCount{ 0.0, 1e7 };
constexpr Range shownInterval{ 0.0, 1e7 };

/// Returns the options of a stage that draws radii, with their table as text or as a file.
template <typename Stage, typename Options>
PropertyList<Stage> withRadiusTable()
{
  return PropertyList<Stage>()
    .include(&Stage::options, Options::properties())
    .add(
      "RadiusTable", &Stage::radiusTable, "Radii in µm to draw from, each as likely as the others, separated by blanks or commas")
    .where("RadiusDistribution", { 2 })
    .add("RadiusTableFile", &Stage::radiusTableFile, "Text file of such radii, instead of RadiusTable")
    .where("RadiusDistribution", { 2 })
    .add("RadiusTableColumn", &Stage::radiusTableColumn,
      "Column of RadiusTableFile that has the radii, where its first line names columns (.csv); none: a mere list")
    .where("RadiusDistribution", { 2 })
    .whereGiven("RadiusTableFile")
    .add("RadiusTableFactor", &Stage::radiusTableFactor, tableFactor,
      "What the numbers of RadiusTableFile are multiplied by to be outer radii in µm: 0.5 for diameters, 1/g for inner radii")
    .where("RadiusDistribution", { 2 })
    .whereGiven("RadiusTableFile");
}

template <typename Stage>
StageDescription description(const char* name)
{
  // States refer to the facts of the list, which is static.
  StageDescription stage = { name, {} };
  for (const PropertyState& state : Stage::properties().states(Stage()))
  {
    if (state.facts->use != PropertyUse::Code)
    {
      stage.properties.push_back(state);
    }
  }
  return stage;
}

} // namespace

const PropertyList<BundleInitializerStage>& BundleInitializerStage::properties()
{
  static const auto list = withRadiusTable<BundleInitializerStage, BundleInitializerOptions>();
  return list;
}

const PropertyList<TractFibresStage>& TractFibresStage::properties()
{
  static const auto list = withRadiusTable<TractFibresStage, TractFibresOptions>();
  return list;
}

const PropertyList<CapsuleOptimizerStage>& CapsuleOptimizerStage::properties()
{
  using Stage = CapsuleOptimizerStage;
  static const auto list =
    PropertyList<Stage>()
      .include(&Stage::options, CapsuleOptimizerOptions::properties())
      .at("RadiusWeight")
      .whereGiven("RadiusTolerance")
      .at("CheckpointInterval")
      .whereGiven("CheckpointFile")
      .add("TrimToDomain", &Stage::trimToDomain, "Cut away what lies outside the domain, but for what growth could bring back in")
      .add("KeepHistory", &Stage::keepHistory, "Keep states of the run and offer them as time steps")
      .use(PropertyUse::Run)
      .add(
        "HistoryInterval", &Stage::historyInterval, limits::historyInterval, "Iterations from one state that is kept to the next")
      .where("KeepHistory", { 1.0 })
      .use(PropertyUse::Run)
      .add("ShowEvery", &Stage::showEvery, shownInterval,
        "Iterations from one state that the window shows to the next while the optimiser works on; 0: the window waits for the "
        "result")
      .where("KeepHistory", { 0.0 })
      .use(PropertyUse::Run)
      .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
      .use(PropertyUse::Run);
  return list;
}

const PropertyList<FibreRadialGrowthStage>& FibreRadialGrowthStage::properties()
{
  using Stage = FibreRadialGrowthStage;
  static const auto list = PropertyList<Stage>()
                             .include(&Stage::options, FibreRadialGrowthOptions::properties())
                             .at("Seed")
                             .whereGiven("SurfaceRoughness")
                             .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
                             .use(PropertyUse::Run);
  return list;
}

const PropertyList<MyelinSurfaceStage>& MyelinSurfaceStage::properties()
{
  using Stage = MyelinSurfaceStage;
  static const auto list =
    PropertyList<Stage>()
      .include(&Stage::options, MyelinSurfaceOptions::properties())
      .at("SmoothingIterations")
      .where("Meshing", { 0 })
      .at("DecimationError")
      .where("Meshing", { 0 })
      .at("MinimumAngle")
      .where("Meshing", { 0 })
      .at("Seed")
      .where("GRatioModel", { 2 })
      .add("Meshing", &Stage::meshing, { "CACTUS", "VTK filters" },
        "What makes the surfaces: contouring, coarsening and spacing with guarantees, or filters of VTK, which promise nothing")
      .include(&Stage::vtkMeshing, VtkMeshingOptions::properties())
      .at("SincIterations")
      .where("Meshing", { 1 })
      .at("SincPassBand")
      .where("Meshing", { 1 })
      .at("TargetReduction")
      .where("Meshing", { 1 })
      .add("ReleaseInput", &Stage::releaseInput, "Give the label image's memory back as soon as the surfaces are made")
      .use(PropertyUse::Run)
      .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
      .use(PropertyUse::Run);
  return list;
}

const PropertyList<FibreFieldStage>& FibreFieldStage::properties()
{
  using Stage = FibreFieldStage;
  static const auto list =
    PropertyList<Stage>()
      .add("Select", &Stage::select, { "One fibre", "One bundle", "All fibres" }, "Whose fields to give")
      .add("FibreId", &Stage::fibreId, limits::id, "The fibre")
      .where("Select", { 0 })
      .add("BundleId", &Stage::bundleId, limits::id, "The bundle")
      .where("Select", { 1 })
      .add("Level", &Stage::level, limits::level, "Depth at which the field will be contoured, for which its caps are made")
      .add("ClipToDomain", &Stage::clipToDomain, "Cut fibres off at the faces of the domain; else where the image ends")
      .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
      .use(PropertyUse::Run);
  return list;
}

const PropertyList<SubstrateStatisticsStage>& SubstrateStatisticsStage::properties()
{
  using Stage = SubstrateStatisticsStage;
  static const auto list = PropertyList<Stage>()
                             .include(&Stage::options, SubstrateStatisticsOptions::properties())
                             .add("NumberOfBins", &Stage::bins, limits::bins, "Number of bins of each histogram")
                             .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
                             .use(PropertyUse::Run);
  return list;
}

const PropertyList<SubstrateCertificateStage>& SubstrateCertificateStage::properties()
{
  using Stage = SubstrateCertificateStage;
  static const auto list = PropertyList<Stage>()
                             .include(&Stage::options, SubstrateCertificateOptions::properties())
                             .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
                             .use(PropertyUse::Run);
  return list;
}

const PropertyList<SubstrateSamplerStage>& SubstrateSamplerStage::properties()
{
  using Stage = SubstrateSamplerStage;
  static const auto list = PropertyList<Stage>()
                             .include(&Stage::options, SubstrateSamplerOptions::properties())
                             .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
                             .use(PropertyUse::Run);
  return list;
}

const PropertyList<HistologyMaskStage>& HistologyMaskStage::properties()
{
  using Stage = HistologyMaskStage;
  static const auto list = PropertyList<Stage>()
                             .include(&Stage::options, HistologyMaskOptions::properties())
                             .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
                             .use(PropertyUse::Run);
  return list;
}

const PropertyList<HistologyRadiiStage>& HistologyRadiiStage::properties()
{
  using Stage = HistologyRadiiStage;
  static const auto list = PropertyList<Stage>()
                             .add("PixelSize", &Stage::pixelSize, maskPixel, "Edge of a pixel")
                             .add("SmallestRadius", &Stage::smallestRadius, leastRadius, "Axons below it are left out")
                             .add("LeaveOutBorder", &Stage::leaveOutBorder,
                               "Leave out fibres that reach the border of the image, where they are cut off");
  return list;
}

const PropertyList<SubstrateWriterStage>& SubstrateWriterStage::properties()
{
  using Stage = SubstrateWriterStage;
  static const auto list =
    PropertyList<Stage>()
      .add("FolderName", &Stage::folderName, "The folder to write; the folder that it is in has to exist")
      .use(PropertyUse::Run)
      .add("Format", &Stage::format, formats, formatMeaning)
      .add("Encoding", &Stage::encoding, encodingNames, encodingMeaning)
      .add("Permeability", &Stage::permeability, partOfHits, "Part of the hits on a surface that lead walkers through it")
      .where("Format", { 0 })
      .add("VoxelSize", &Stage::voxelSize, sampledVoxel, "Edge of a voxel of the labels; it has to divide the domain's sides")
      .where("Format", { 4 })
      .add("StartPositions", &Stage::startPositions, startCount, "Points to draw in each compartment, for walkers to start from")
      .where("Format", { 0, 1, 2, 3, 5, 7, 8 })
      .add("Seed", &Stage::seed, limits::seed, "Chooses the random points")
      .where("Format", { 0, 1, 2, 3, 5, 7, 8 })
      .whereGiven("StartPositions")
      .add("AllowOpenSurfaces", &Stage::allowOpenSurfaces,
        "Write surfaces that are not closed, outward 2-manifolds too, instead of refusing them")
      .add("MinimumGap", &Stage::minimumGap, limits::judgedGap,
        "Distance that the certificate asks of the outer surfaces of any two fibres; -1: MinimumGap of the growth that they come "
        "from; 0, or where they do not say it: they must not meet")
      .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
      .use(PropertyUse::Run);
  return list;
}

const PropertyList<SubstrateProductionStage>& SubstrateProductionStage::properties()
{
  using Stage = SubstrateProductionStage;
  static const auto list =
    PropertyList<Stage>()
      .include(&Stage::growth, FibreRadialGrowthOptions::properties())
      .include(&Stage::surfaces, MyelinSurfaceOptions::properties()) // its Seed replaces the other one
      .at("Seed")
      .means(
        "Seed of the calibre that SurfaceRoughness gives the fibres, of their g-ratios where GRatioModel is Distributed, and of "
        "the sample where SampledFraction is below 1")
      .add("FolderName", &Stage::folderName, "The folder to write; the folder that it is in has to exist")
      .use(PropertyUse::Run)
      .add("Format", &Stage::format, formats, formatMeaning)
      .add("Encoding", &Stage::encoding, encodingNames, encodingMeaning)
      .add("AllowOpenSurfaces", &Stage::allowOpenSurfaces,
        "Write surfaces that are not closed, outward 2-manifolds too, instead of refusing them")
      .add("SampledFraction", &Stage::sampledFraction, limits::sampledFraction,
        "Part of the fibres whose surfaces are made, drawn at random by Seed, in place among all the others; 1: all. Less is for "
        "Format "
        "Surfaces alone and Surfaces by bundle, where no g-ratio is for TargetAxonVolumeFraction, and refused otherwise")
      .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
      .use(PropertyUse::Run);
  return list;
}

const PropertyList<StrandReaderStage>& StrandReaderStage::properties()
{
  using Stage = StrandReaderStage;
  static const auto list = PropertyList<Stage>().add("FileName", &Stage::fileName,
    "The file to read: strands, a table of CATERPillar, or what the White Matter Generator has written");
  return list;
}

const PropertyList<StrandWriterStage>& StrandWriterStage::properties()
{
  using Stage = StrandWriterStage;
  static const auto list =
    PropertyList<Stage>().add("FileName", &Stage::fileName, "The strand file to write").use(PropertyUse::Run);
  return list;
}

const PropertyList<TractogramReaderStage>& TractogramReaderStage::properties()
{
  using Stage = TractogramReaderStage;
  static const auto list =
    PropertyList<Stage>()
      .add("FileName", &Stage::fileName, "The tractogram to read: .tck, .trk, or .trx (an archive or a folder)")
      .add("LengthUnit", &Stage::lengthUnit, { "Micrometre", "Millimetre" }, "Unit of the lengths that come out; files have mm")
      .add("Radius", &Stage::radius, limits::radiusOrNone, "Radius of every point where the file has none; 0: no radius");
  return list;
}

const PropertyList<TractogramWriterStage>& TractogramWriterStage::properties()
{
  using Stage = TractogramWriterStage;
  static const auto list = PropertyList<Stage>()
                             .add("FileName", &Stage::fileName, "The file to write: .tck or .trx")
                             .use(PropertyUse::Run)
                             .add("LengthUnit", &Stage::lengthUnit, { "Micrometre", "Millimetre" }, fileUnit);
  return list;
}

const PropertyList<PlacementStage>& PlacementStage::properties()
{
  static const auto list = PropertyList<PlacementStage>().include(&PlacementStage::options, PlacementOptions::properties());
  return list;
}

const PropertyList<NiftiWriterStage>& NiftiWriterStage::properties()
{
  using Stage = NiftiWriterStage;
  static const auto list = PropertyList<Stage>()
                             .add("FileName", &Stage::fileName, "The file to write: .nii or .nii.gz")
                             .use(PropertyUse::Run)
                             .add("Array", &Stage::array, "Name of the point data to write; empty: those that views show first")
                             .add("LengthUnit", &Stage::lengthUnit, { "Micrometre", "Millimetre" }, fileUnit);
  return list;
}

std::vector<StageDescription> describeStages()
{
  return { description<BundleInitializerStage>("BundleInitializer"), description<StrandReaderStage>("StrandReader"),
    description<TractogramReaderStage>("TractogramReader"), description<TractFibresStage>("TractFibres"),
    description<CapsuleOptimizerStage>("CapsuleOptimizer"), description<FibreRadialGrowthStage>("FibreRadialGrowth"),
    description<FibreFieldStage>("FibreField"), description<MyelinSurfaceStage>("MyelinSurface"),
    description<SubstrateStatisticsStage>("SubstrateStatistics"), description<SubstrateCertificateStage>("SubstrateCertificate"),
    description<SubstrateSamplerStage>("SubstrateSampler"), description<HistologyMaskStage>("HistologyMask"),
    description<HistologyRadiiStage>("HistologyRadii"), description<SubstrateWriterStage>("SubstrateWriter"),
    description<SubstrateProductionStage>("SubstrateProduction"), description<PlacementStage>("Placement"),
    description<StrandWriterStage>("StrandWriter"), description<TractogramWriterStage>("TractogramWriter"),
    description<NiftiWriterStage>("NiftiWriter") };
}

} // namespace cactus
