// SPDX-License-Identifier: BSD-3-Clause
#include "stages/Stages.h"

#include "base/Limits.h"
#include "io/SubstrateContents.h"

#include <iterator>

namespace cactus
{

namespace
{

constexpr char threadsMeaning[] = "Number of threads; 0 uses all. Results do not depend on it.";

// Properties of writers.
constexpr char folderMeaning[] =
  "Folder to write. Its parent folder has to exist; links are followed and kept. It cannot be the folder that ParaView runs in.";
const std::vector<std::string> formats(std::begin(formatNames), std::end(formatNames));
constexpr char formatMeaning[] =
  "Simulator that will read the folder. Reference program: the folder that dmipy-sim loads; Substrate Writer needs Inner and "
  "Fibres for it. RMS: voxel labels; those of Substrate Production are as large as the voxels of growth. SpinDoctor, or other "
  "finite elements: one complex of triangles, which tetgen fills with tetrahedra. MCMRSimulator: its geometry file, with "
  "reflecting walls at the faces of the domain. For no simulator: Surfaces alone has one PLY file for each surface; Surfaces by "
  "bundle has one for all outer and one for all inner surfaces of each bundle.";
const std::vector<std::string> encodingNames{ "ASCII", "Binary" };
constexpr char encodingMeaning[] =
  "Encoding of PLY files. Binary takes 19 bytes per triangle, half of ASCII, in single precision; the certificate judges the "
  "surfaces with that rounding. Binary is for Format RMS, Surfaces alone, Surfaces by bundle, SpinDoctor and MCMRSimulator. The "
  "other simulators read only ASCII, and Binary is refused for them.";
const std::vector<std::string> endsInFaces(std::begin(periodicFacesNames), std::end(periodicFacesNames));
constexpr char periodicFacesMeaning[] =
  "How surfaces end in the faces of a periodic domain (Border Periodic or Periodic across of BundleInitializer). Caps: each "
  "piece "
  "of a fibre is closed, so that walkers inside stay in their piece. Open: without caps in these faces. Copies of the domain, in "
  "a simulator that repeats it, then join to endless surfaces, and walkers inside the fibres go on, too. By format: Caps, but "
  "for "
  "MC/DC, which with caps lets some walkers outside into the fibres, Open (unless AllowOpenSurfaces is on). The certificate "
  "judges the surfaces with their caps. Open is for Format MC/DC, Surfaces alone and Surfaces by bundle. It is refused for other "
  "formats, whose readers need closed surfaces, for a domain that is not periodic, and with AllowOpenSurfaces.";
constexpr char fileUnit[] = "Unit of the file's lengths. Most readers take them for millimetres, whatever the file says, so "
                            "micrometres give a warning. For data that Placement has placed, micrometres are refused.";
constexpr Range leastRadius{ 0.0, 1e3, " µm" };
constexpr Range tableFactor{ 1e-6, 1e6 };
constexpr Range concentration{ 0.1, 1e9, "", 0.0 };
constexpr Range dispersionIndex{ 1e-9, 0.99, "", 0.0 };
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
      "Outer radii in µm, separated by blanks or commas, for example \"0.4 0.5 0.7\". Each fibre gets one of them at random; all "
      "entries are equally likely.")
    .where("RadiusDistribution", { 2 })
    .add("RadiusTableFile", &Stage::radiusTableFile,
      "Text file of outer radii in µm, separated by blanks, commas or line ends. It replaces RadiusTable.")
    .where("RadiusDistribution", { 2 })
    .add("RadiusTableColumn", &Stage::radiusTableColumn,
      "Column of RadiusTableFile with the radii, if the file is a table whose first line names the columns (.csv), such as "
      "FibreRadius_um of HistologyRadii. Leave it empty for a plain list.")
    .where("RadiusDistribution", { 2 })
    .whereGiven("RadiusTableFile")
    .add("RadiusTableFactor", &Stage::radiusTableFactor, tableFactor,
      "Factor that turns the numbers of RadiusTableFile into outer radii in µm: 0.5 for diameters, 1/g for radii of axons "
      "without their myelin.")
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
  static const auto list =
    withRadiusTable<BundleInitializerStage, BundleInitializerOptions>()
      .add("WatsonKappa", &BundleInitializerStage::watsonKappa, concentration,
        "Concentration κ of Watson's distribution of angles (DispersionModel Watson, Coherent or Peaks), in place of "
        "MeanDispersion: 104 for 5°, 26.8 for 10°, 7.8 for 20°. 0: MeanDispersion or ODI says it.")
      .add("ODI", &BundleInitializerStage::odi, dispersionIndex,
        "Orientation dispersion index (2/π) arctan(1/κ) in place of MeanDispersion: 0.006 for 5°, 0.024 for 10°, 0.081 for 20°. "
        "0: MeanDispersion or WatsonKappa says it.")
      .at("MeanDispersion")
      .where("WatsonKappa", { 0 })
      .where("ODI", { 0 })
      .add("OrientationHarmonics", &BundleInitializerStage::orientationHarmonics,
        "Coefficients of the distribution of directions in real spherical harmonics of even degrees, in the basis and order of "
        "MRtrix: 1, 6, 15, 28 or 45 numbers (degrees up to 0, 2, 4, 6 or 8; at most 16), separated by blanks or commas. The axes "
        "are those of the domain; the scale does not matter, and negative values count as 0. One number: all directions alike. "
        "Fibres are laid with a sharper distribution, by as much as they will broaden it where FibreVolumeFraction of the domain "
        "is filled, so let one source have all of it.")
      .where("DispersionModel", { 3 })
      .add("OrientationPeaks", &BundleInitializerStage::orientationPeaks,
        "Bundles of the dispersion model Peaks: x, y and z of a vector for each, separated by blanks or commas. Its direction is "
        "the bundle's axis, and its length goes with the bundle's share of the fibres' volume; 0 0 0: no fibres. Bundles have "
        "the "
        "ids 1, 2 and so on. For example \"0.5 0 0 0 0.3 0.3\".")
      .where("DispersionModel", { 4 })
      .add("OrientationFile", &BundleInitializerStage::orientationFile,
        "NIfTI image (.nii, .nii.gz) with OrientationHarmonics or OrientationPeaks in each voxel, in place of them, such as "
        "those "
        "of MRtrix's dwi2fod and sh2peaks, or the arrays FOD and Peaks of SubstrateSampler. Axes of the domain are those of the "
        "scanner. cactus-grow reads no images; a manifest has the numbers.")
      .where("DispersionModel", { 3, 4 })
      .add("OrientationVoxel", &BundleInitializerStage::orientationVoxel,
        "Voxel of OrientationFile: its whole numbers i, j and k in the order of the file, from 0, as nibabel and FSLeyes have "
        "them. mrview numbers the voxels of some images otherwise, since it turns their axes.")
      .where("DispersionModel", { 3, 4 })
      .whereGiven("OrientationFile");
  return list;
}

const PropertyList<CurvedBundlesStage>& CurvedBundlesStage::properties()
{
  static const auto list = withRadiusTable<CurvedBundlesStage, CurvedBundlesOptions>();
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
      .add("TrimToDomain", &Stage::trimToDomain,
        "Cut away what lies outside the domain. Fibres are kept as far as growth by up to their radius could bring them back in. "
        "A fibre that leaves the domain and comes back becomes several fibres.")
      .add("KeepHistory", &Stage::keepHistory,
        "Keep states of the run and offer them as time steps, so that you can play the run as an animation. The time is the "
        "iteration; the last one shows the result. The times are known after the run, which starts as soon as they are "
        "requested. Each state takes 12 bytes per control point (16 if RadiusTolerance is above 0). Filters that follow see the "
        "state of the current time. The input is taken at its last time.")
      .use(PropertyUse::Run)
      .add("HistoryInterval", &Stage::historyInterval, limits::historyInterval,
        "Number of iterations between two states that are kept.")
      .where("KeepHistory", { 1.0 })
      .use(PropertyUse::Run)
      .add("ShowEvery", &Stage::showEvery, shownInterval,
        "Number of iterations between two states that the window shows during the run. The window stays responsive, and Stop "
        "ends the run with its best state; the result is the same. 0: the window waits for the result. Filters that follow see "
        "the state that is shown, so apply this filter first. Leave it at 0 in scripts: they get the state reached so far, with "
        "Converged 0.")
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
      .at("MyelinFollowsAxon")
      .where("Meshing", { 0 })
      .at("NodeLength")
      .where("Meshing", { 0 })
      .at("SwellingAmplitude")
      .where("Meshing", { 0 })
      .at("SmoothingIterations")
      .where("Meshing", { 0 })
      .at("DecimationError")
      .where("Meshing", { 0 })
      .at("MinimumAngle")
      .where("Meshing", { 0 })
      .add("Meshing", &Stage::meshing, { "CACTUS", "VTK filters" },
        "Method that makes the surfaces. CACTUS: its own contouring, coarsening and spacing, which keep surfaces closed, apart "
        "and free of self-intersections. VTK filters: Flying Edges on each fibre's field, Windowed Sinc smoothing and Quadric "
        "Decimation, as in ParaView's filters. They guarantee none of this, take longer and give more triangles. The column "
        "Flawed then marks faults, and Substrate Certificate judges as usual.")
      .include(&Stage::vtkMeshing, VtkMeshingOptions::properties())
      .at("SincIterations")
      .where("Meshing", { 1 })
      .at("SincPassBand")
      .where("Meshing", { 1 })
      .at("TargetReduction")
      .where("Meshing", { 1 })
      .add("ReleaseInput", &Stage::releaseInput,
        "Free the label image's memory (8 bytes per voxel) as soon as the surfaces are made. This is for large substrates in "
        "scripts that need the image for nothing else. If another filter asks for the image, it is grown again.")
      .use(PropertyUse::Run)
      .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
      .use(PropertyUse::Run);
  return list;
}

const PropertyList<FibreFieldStage>& FibreFieldStage::properties()
{
  using Stage = FibreFieldStage;
  static const auto list = PropertyList<Stage>()
                             .add("Select", &Stage::select, { "One fibre", "One bundle", "All fibres" },
                               "Fibres whose fields are made. All fibres of a large substrate take much memory: 4 bytes for each "
                               "voxel of the box around each fibre.")
                             .add("FibreId", &Stage::fibreId, limits::idOrFirst,
                               "FibreId of the fibre; 0 is the first one that the label image has, whatever its number.")
                             .where("Select", { 0 })
                             .add("BundleId", &Stage::bundleId, limits::id, "BundleId of the bundle.")
                             .where("Select", { 1 })
                             .add("Level", &Stage::level, limits::level,
                               "Value in µm at which the field will be contoured: 0 for outer surfaces, a depth inside the fibre "
                               "for the surface of an axon. The caps on the faces of the domain are made for it.")
                             .add("ClipToDomain", &Stage::clipToDomain,
                               "Cut fibres off at the faces of the domain. If off, they reach to the end of the image.")
                             .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
                             .use(PropertyUse::Run);
  return list;
}

const PropertyList<SubstrateStatisticsStage>& SubstrateStatisticsStage::properties()
{
  using Stage = SubstrateStatisticsStage;
  static const auto list = PropertyList<Stage>()
                             .include(&Stage::options, SubstrateStatisticsOptions::properties())
                             .add("NumberOfBins", &Stage::bins, limits::bins, "Number of bins of each histogram.")
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

const PropertyList<LesionStage>& LesionStage::properties()
{
  using Stage = LesionStage;
  static const auto list = PropertyList<Stage>()
                             .include(&Stage::options, LesionOptions::properties())
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
      .add("PixelSize", &Stage::pixelSize, maskPixel,
        "Edge of a pixel in µm. A mask that comes directly from HistologyMask has its own pixel size; another value is an error.")
      .add("SmallestRadius", &Stage::smallestRadius, leastRadius,
        "Smallest radius in µm. Smaller axons, such as specks of a few pixels, are left out.")
      .add("LeaveOutBorder", &Stage::leaveOutBorder,
        "Leave out fibres that touch the border of the image, because they are cut off there.")
      .add("AxonColour", &Stage::axonColour, { maskColourNames.begin(), maskColourNames.end() },
        "Colour of axons in the mask. White is 191 to 255. Of a mask in colours, such as one drawn over its image, choose the "
        "name "
        "closest to theirs; transparent pixels are background.")
      .add("MyelinColour", &Stage::myelinColour, { maskColourNames.begin(), maskColourNames.end() },
        "Colour of myelin in the mask; another one than AxonColour. Grey is 64 to below 191. With White and Grey, a mask that "
        "has "
        "other colours is refused.");
  return list;
}

const PropertyList<SubstrateWriterStage>& SubstrateWriterStage::properties()
{
  using Stage = SubstrateWriterStage;
  static const auto list =
    PropertyList<Stage>()
      .add("FolderName", &Stage::folderName, folderMeaning)
      .use(PropertyUse::Run)
      .add("Format", &Stage::format, formats, formatMeaning)
      .add("Encoding", &Stage::encoding, encodingNames, encodingMeaning)
      .add("Permeability", &Stage::permeability, partOfHits,
        "Fraction of the hits on a surface after which a walker passes through it, 0 to 1, as MC/DC defines it. "
        "mcdc/*_ply_list.txt lists it for each surface, so that you can edit it. 0: no walker passes.")
      .where("Format", { 0 })
      .add("VoxelSize", &Stage::voxelSize, sampledVoxel,
        "Edge of a label's voxel in µm. It has to divide the domain's sides, and to be smaller than the myelin between two "
        "axons. If it is wider than the gaps between fibres, extra/ may be left out, with a warning.")
      .where("Format", { 4 })
      .add("StartPositions", &Stage::startPositions, startCount,
        "Number of random points in each compartment at which walkers start (start/intra.txt, myelin.txt, extra.txt). 0: none; "
        "for MC/DC with Permeability, one for each of its 1,000 walkers.")
      .where("Format", { 0, 1, 2, 3, 5, 7, 8 })
      .add("Seed", &Stage::seed, limits::seed, "Seed of the random points. The same seed gives the same points.")
      .where("Format", { 0, 1, 2, 3, 5, 7, 8 })
      .whereGiven("StartPositions")
      .add("PeriodicFaces", &Stage::periodicFaces, endsInFaces, periodicFacesMeaning)
      .where("Format", { 0, 5, 7 })
      .add("AllowOpenSurfaces", &Stage::allowOpenSurfaces,
        "Also write surfaces that are not closed, outward 2-manifolds. Walkers leak through them.")
      .add("MinimumGap", &Stage::minimumGap, limits::judgedGap,
        "Smallest distance in µm that the certificate requires between the outer surfaces of two fibres. -1: the distance that "
        "they promise, which is the MinimumGap of their FibreRadialGrowth. 0: they only must not meet; -1 means the same for "
        "surfaces that promise nothing, such as those of a file. MinimumGap_um in certificate.csv is the distance used.")
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
      .means("Seed of the directions in which sections of fibres are elongated (SectionAxisRatio of bundles), of the random "
             "calibre that SurfaceRoughness gives the fibres, of the points of SeedDensity, of the g-ratios if GRatioModel is "
             "Distributed, of the places of swellings, and of the sample if SampledFraction is below 1.")
      .add("FolderName", &Stage::folderName, folderMeaning)
      .use(PropertyUse::Run)
      .add("Format", &Stage::format, formats, formatMeaning)
      .add("Encoding", &Stage::encoding, encodingNames, encodingMeaning)
      .add("PeriodicFaces", &Stage::periodicFaces, endsInFaces, periodicFacesMeaning)
      .where("Format", { 0, 5, 7 })
      .add("AllowOpenSurfaces", &Stage::allowOpenSurfaces,
        "Also write surfaces that are not closed, outward 2-manifolds. Walkers leak through them.")
      .add("SampledFraction", &Stage::sampledFraction, limits::sampledFraction,
        "Fraction of the fibres whose surfaces are made, drawn at random by Seed, each in its place among all the others. 1 "
        "makes all. A sample shows what a large substrate will be like, and what it will take, before all of it is made. A "
        "larger sample contains the fibres of a smaller one. Less than 1 is only for Format Surfaces alone and Surfaces by "
        "bundle, since the space between the surfaces of a sample is not extra-axonal, and only if GRatioModel is not "
        "TargetAxonVolumeFraction, which depends on all fibres. Otherwise it is refused.")
      .add("NumberOfThreads", &Stage::threads, limits::threads, threadsMeaning)
      .use(PropertyUse::Run);
  return list;
}

const PropertyList<StrandReaderStage>& StrandReaderStage::properties()
{
  using Stage = StrandReaderStage;
  static const auto list = PropertyList<Stage>().add("FileName", &Stage::fileName,
    "File to read: strands, CATERPillar's table of spheres, or JSON of the White Matter Generator.");
  return list;
}

const PropertyList<SubstrateReaderStage>& SubstrateReaderStage::properties()
{
  using Stage = SubstrateReaderStage;
  static const auto list = PropertyList<Stage>().add("FileName", &Stage::fileName,
    "Substrate folder to read, or its manifest.json. What it gives is in µm and in the substrate's own space, even if the "
    "substrate was placed in an image.");
  return list;
}

const PropertyList<StrandWriterStage>& StrandWriterStage::properties()
{
  using Stage = StrandWriterStage;
  static const auto list = PropertyList<Stage>().add("FileName", &Stage::fileName, "Strand file to write.").use(PropertyUse::Run);
  return list;
}

const PropertyList<TractogramReaderStage>& TractogramReaderStage::properties()
{
  using Stage = TractogramReaderStage;
  static const auto list =
    PropertyList<Stage>()
      .add("FileName", &Stage::fileName, "Tractogram to read. A .trx may be a folder.")
      .add("LengthUnit", &Stage::lengthUnit, { "Micrometre", "Millimetre" },
        "Unit of the output's lengths: micrometres, as in all stages of CACTUS, or millimetres, as in images.")
      .add("Radius", &Stage::radius, limits::radiusOrNone,
        "Radius in µm, 0.001 to 1000, of every point if the file has no Radius. 0: the points get none.");
  return list;
}

const PropertyList<TractogramWriterStage>& TractogramWriterStage::properties()
{
  using Stage = TractogramWriterStage;
  static const auto list = PropertyList<Stage>()
                             .add("FileName", &Stage::fileName, "File to write: .tck or .trx.")
                             .use(PropertyUse::Run)
                             .add("LengthUnit", &Stage::lengthUnit, { "Micrometre", "Millimetre" }, fileUnit);
  return list;
}

const PropertyList<PlacementStage>& PlacementStage::properties()
{
  static const auto list = PropertyList<PlacementStage>().include(&PlacementStage::options, PlacementOptions::properties());
  return list;
}

const PropertyList<NiftiReaderStage>& NiftiReaderStage::properties()
{
  using Stage = NiftiReaderStage;
  static const auto list = PropertyList<Stage>()
                             .add("FileName", &Stage::fileName, "Image to read: .nii or .hdr, which may be packed by gzip.")
                             .add("LengthUnit", &Stage::lengthUnit, { "Micrometre", "Millimetre" },
                               "Unit of the output's lengths: millimetres, as in images and for substrates that Placement has "
                               "placed, or micrometres, as in all "
                               "stages of CACTUS.");
  return list;
}

const PropertyList<NiftiWriterStage>& NiftiWriterStage::properties()
{
  using Stage = NiftiWriterStage;
  static const auto list = PropertyList<Stage>()
                             .add("FileName", &Stage::fileName, "File to write: .nii or .nii.gz.")
                             .use(PropertyUse::Run)
                             .add("Array", &Stage::array,
                               "Name of the point data to write, such as AVF or Compartment. Empty: the active scalars. Save "
                               "Data proposes FibreId of a label "
                               "image.")
                             .add("LengthUnit", &Stage::lengthUnit, { "Micrometre", "Millimetre" }, fileUnit);
  return list;
}

std::vector<StageDescription> describeStages()
{
  return { description<BundleInitializerStage>("BundleInitializer"), description<CurvedBundlesStage>("CurvedBundles"),
    description<StrandReaderStage>("StrandReader"), description<TractogramReaderStage>("TractogramReader"),
    description<TractFibresStage>("TractFibres"), description<CapsuleOptimizerStage>("CapsuleOptimizer"),
    description<FibreRadialGrowthStage>("FibreRadialGrowth"), description<FibreFieldStage>("FibreField"),
    description<MyelinSurfaceStage>("MyelinSurface"), description<SubstrateStatisticsStage>("SubstrateStatistics"),
    description<SubstrateCertificateStage>("SubstrateCertificate"), description<LesionStage>("Lesion"),
    description<SubstrateSamplerStage>("SubstrateSampler"), description<HistologyMaskStage>("HistologyMask"),
    description<HistologyRadiiStage>("HistologyRadii"), description<SubstrateWriterStage>("SubstrateWriter"),
    description<SubstrateProductionStage>("SubstrateProduction"), description<PlacementStage>("Placement"),
    description<StrandWriterStage>("StrandWriter"), description<TractogramWriterStage>("TractogramWriter"),
    description<NiftiReaderStage>("NiftiReader"), description<NiftiWriterStage>("NiftiWriter"),
    description<SubstrateReaderStage>("SubstrateReader") };
}

} // namespace cactus
