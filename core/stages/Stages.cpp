// SPDX-License-Identifier: BSD-3-Clause
#include "stages/Stages.h"

#include "base/Limits.h"
#include "io/SubstrateContents.h"

#include <iterator>

namespace cactus
{

namespace
{

constexpr char threadsMeaning[] = "Number of threads; 0 uses all. Results do not depend on it";

// Properties of writers.
const std::vector<std::string> formats(std::begin(formatNames), std::end(formatNames));
constexpr char formatMeaning[] = "Simulator that will read the folder, or none";
const std::vector<std::string> encodingNames{ "ASCII", "Binary" };
constexpr char encodingMeaning[] = "Encoding of PLY files; Binary takes half the space. Binary is for Format RMS, Surfaces "
                                   "alone, SpinDoctor, Surfaces by bundle and MCMRSimulator, and refused for others";
constexpr char fileUnit[] =
  "Unit of the file's lengths. Readers take them for millimetres, whatever the header says; placed data need millimetres";
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
    .add("RadiusTable", &Stage::radiusTable,
      "Outer radii in µm, separated by blanks or commas; each fibre gets one at random, all equally likely")
    .where("RadiusDistribution", { 2 })
    .add("RadiusTableFile", &Stage::radiusTableFile, "Text file of outer radii in µm, which replaces RadiusTable")
    .where("RadiusDistribution", { 2 })
    .add("RadiusTableColumn", &Stage::radiusTableColumn,
      "Column of RadiusTableFile with the radii, if its first line names the columns (.csv); none: a plain list")
    .where("RadiusDistribution", { 2 })
    .whereGiven("RadiusTableFile")
    .add("RadiusTableFactor", &Stage::radiusTableFactor, tableFactor,
      "Factor that turns the numbers of RadiusTableFile into outer radii in µm: 0.5 for diameters, 1/g for inner radii")
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
      .add("TrimToDomain", &Stage::trimToDomain, "Cut away what lies outside the domain, except what growth could bring back in")
      .add("KeepHistory", &Stage::keepHistory, "Keep states of the run and offer them as time steps")
      .use(PropertyUse::Run)
      .add("HistoryInterval", &Stage::historyInterval, limits::historyInterval,
        "Number of iterations between two states that are kept")
      .where("KeepHistory", { 1.0 })
      .use(PropertyUse::Run)
      .add("ShowEvery", &Stage::showEvery, shownInterval,
        "Number of iterations between two states that the window shows during the run; 0: the window waits for the result")
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
        "Method that makes the surfaces: contouring, coarsening and spacing with guarantees, or VTK's filters, which guarantee "
        "nothing")
      .include(&Stage::vtkMeshing, VtkMeshingOptions::properties())
      .at("SincIterations")
      .where("Meshing", { 1 })
      .at("SincPassBand")
      .where("Meshing", { 1 })
      .at("TargetReduction")
      .where("Meshing", { 1 })
      .add("ReleaseInput", &Stage::releaseInput, "Free the label image's memory as soon as the surfaces are made")
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
      .add("Select", &Stage::select, { "One fibre", "One bundle", "All fibres" }, "Fibres whose fields are made")
      .add("FibreId", &Stage::fibreId, limits::id, "Number of the fibre")
      .where("Select", { 0 })
      .add("BundleId", &Stage::bundleId, limits::id, "Number of the bundle")
      .where("Select", { 1 })
      .add("Level", &Stage::level, limits::level, "Depth at which the field will be contoured; caps are made for it")
      .add("ClipToDomain", &Stage::clipToDomain, "Cut fibres off at the faces of the domain; if off, at the end of the image")
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
  static const auto list =
    PropertyList<Stage>()
      .add("PixelSize", &Stage::pixelSize, maskPixel, "Edge of a pixel")
      .add("SmallestRadius", &Stage::smallestRadius, leastRadius, "Smallest radius of an axon; thinner ones are left out")
      .add(
        "LeaveOutBorder", &Stage::leaveOutBorder, "Leave out fibres that reach the border of the image, where they are cut off");
  return list;
}

const PropertyList<SubstrateWriterStage>& SubstrateWriterStage::properties()
{
  using Stage = SubstrateWriterStage;
  static const auto list =
    PropertyList<Stage>()
      .add("FolderName", &Stage::folderName, "Folder to write; its parent folder has to exist")
      .use(PropertyUse::Run)
      .add("Format", &Stage::format, formats, formatMeaning)
      .add("Encoding", &Stage::encoding, encodingNames, encodingMeaning)
      .add("Permeability", &Stage::permeability, partOfHits,
        "Fraction of the hits on a surface after which a walker passes through it")
      .where("Format", { 0 })
      .add("VoxelSize", &Stage::voxelSize, sampledVoxel, "Edge of a label's voxel; it has to divide the domain's sides")
      .where("Format", { 4 })
      .add("StartPositions", &Stage::startPositions, startCount,
        "Number of random points in each compartment at which walkers start")
      .where("Format", { 0, 1, 2, 3, 5, 7, 8 })
      .add("Seed", &Stage::seed, limits::seed, "Seed of the random points")
      .where("Format", { 0, 1, 2, 3, 5, 7, 8 })
      .whereGiven("StartPositions")
      .add("AllowOpenSurfaces", &Stage::allowOpenSurfaces,
        "Also write surfaces that are not closed, outward 2-manifolds, instead of refusing them")
      .add("MinimumGap", &Stage::minimumGap, limits::judgedGap,
        "Smallest distance that the certificate requires between the outer surfaces of two fibres; -1: MinimumGap of their "
        "growth; 0, or -1 if that is unknown: they only must not meet")
      .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
      .use(PropertyUse::Run);
  return list;
}

const PropertyList<SubstrateProductionStage>& SubstrateProductionStage::properties()
{
  using Stage = SubstrateProductionStage;
  static const auto list = PropertyList<Stage>()
                             .include(&Stage::growth, FibreRadialGrowthOptions::properties())
                             .include(&Stage::surfaces, MyelinSurfaceOptions::properties()) // its Seed replaces the other one
                             .at("Seed")
                             .means("Seed of the calibre that SurfaceRoughness gives the fibres, of their g-ratios if "
                                    "GRatioModel is Distributed, and of the sample if SampledFraction is below 1")
                             .add("FolderName", &Stage::folderName, "Folder to write; its parent folder has to exist")
                             .use(PropertyUse::Run)
                             .add("Format", &Stage::format, formats, formatMeaning)
                             .add("Encoding", &Stage::encoding, encodingNames, encodingMeaning)
                             .add("AllowOpenSurfaces", &Stage::allowOpenSurfaces,
                               "Also write surfaces that are not closed, outward 2-manifolds, instead of refusing them")
                             .add("SampledFraction", &Stage::sampledFraction, limits::sampledFraction,
                               "Fraction of the fibres whose surfaces are made, drawn at random by Seed, each in its place among "
                               "all the others; 1: all. Less is only for Format Surfaces alone and Surfaces by bundle, and not "
                               "for GRatioModel TargetAxonVolumeFraction; otherwise it is refused")
                             .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
                             .use(PropertyUse::Run);
  return list;
}

const PropertyList<StrandReaderStage>& StrandReaderStage::properties()
{
  using Stage = StrandReaderStage;
  static const auto list = PropertyList<Stage>().add(
    "FileName", &Stage::fileName, "File to read: strands, CATERPillar's table of spheres, or JSON of the White Matter Generator");
  return list;
}

const PropertyList<StrandWriterStage>& StrandWriterStage::properties()
{
  using Stage = StrandWriterStage;
  static const auto list = PropertyList<Stage>().add("FileName", &Stage::fileName, "Strand file to write").use(PropertyUse::Run);
  return list;
}

const PropertyList<TractogramReaderStage>& TractogramReaderStage::properties()
{
  using Stage = TractogramReaderStage;
  static const auto list =
    PropertyList<Stage>()
      .add("FileName", &Stage::fileName, "Tractogram to read: .tck, .trk, or .trx (an archive or a folder)")
      .add("LengthUnit", &Stage::lengthUnit, { "Micrometre", "Millimetre" }, "Unit of the output's lengths; files have mm")
      .add("Radius", &Stage::radius, limits::radiusOrNone, "Radius of every point if the file has none; 0: no radius");
  return list;
}

const PropertyList<TractogramWriterStage>& TractogramWriterStage::properties()
{
  using Stage = TractogramWriterStage;
  static const auto list = PropertyList<Stage>()
                             .add("FileName", &Stage::fileName, "File to write: .tck or .trx")
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
                             .add("FileName", &Stage::fileName, "File to write: .nii or .nii.gz")
                             .use(PropertyUse::Run)
                             .add("Array", &Stage::array, "Name of the point data to write; empty: the active scalars")
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
