// SPDX-License-Identifier: BSD-3-Clause
#include "surface/MyelinSurfaceOptions.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowthOptions.h"

#include <algorithm>

namespace cactus
{

namespace
{

/// Angles of triangles; 0 means any. Equilateral ones have 60°, and some have little above 25° wherever edge lengths change.
constexpr Range smallestAngles{ 5.0, 25.0, "°", 0.0 };
constexpr Range swellingAmplitudes{ 0.01, 1.0, "", 0.0 };
constexpr Range swellingSpacings{ 1.2, 50.0, " µm" };
constexpr Range swellingLengths{ 1.0, 10.0, " µm" };
constexpr Range nodeLengths{ 0.3, 5.0, " µm", 0.0 };
constexpr Range internodeFactors{ 1.0, 500.0 };
constexpr Range paranodeLengths{ 0.5, 6.0, " µm" };
constexpr Range constrictions{ 0.3, 1.0 };
constexpr Range remyelinated{ 0.3, 0.99 };

} // namespace

const PropertyList<MyelinSurfaceOptions>& MyelinSurfaceOptions::properties()
{
  using Options = MyelinSurfaceOptions;
  static const auto list =
    PropertyList<Options>()
      .add("GRatioModel", &Options::model, { "Constant", "LogLinear", "Distributed", "TargetAxonVolumeFraction" },
        "Model of the myelin's thickness. Constant: the same g-ratio (diameter of the axon over that of the fibre) for all "
        "fibres. LogLinear: myelin of 0.35 + 0.006 D + 0.024 ln D µm for an axon of diameter D (Lee 2019), with g-ratios limited "
        "to 0.3 to 0.95. Distributed: a g-ratio for each fibre from a normal distribution, truncated at 0.3 and 0.95. "
        "TargetAxonVolumeFraction: one g-ratio for all fibres, chosen so that the axons fill the fraction asked for. A fibre "
        "that has a g-ratio of its own (cell data TargetGRatio of the fibres) gets that one; 1 is an axon without myelin.")
      .add("GRatio", &Options::gRatio, limits::gRatio,
        "g-ratio of all fibres (GRatioModel Constant), or its mean (Distributed, from 0.3 to 0.95). It has no effect in the "
        "other models.")
      .where("GRatioModel", { 0, 2 })
      .add("GRatioDeviation", &Options::gRatioDeviation, limits::gRatioDeviation,
        "Standard deviation of the g-ratio from fibre to fibre. It has no effect unless GRatioModel is Distributed.")
      .where("GRatioModel", { 2 })
      .add("TargetAxonVolumeFraction", &Options::targetAxonVolumeFraction, limits::fractionOrNone,
        "Fraction of the domain that the axons should fill, for instance 0.4. It has no effect unless GRatioModel is "
        "TargetAxonVolumeFraction.")
      .where("GRatioModel", { 3 })
      .add("MyelinFollowsAxon", &Options::myelinFollowsAxon,
        "Make myelin thicker where the fibre is thicker, so that each cross-section of a fibre has its g-ratio. If off, the "
        "myelin "
        "of a fibre is equally thick along it. It needs the fibres' centre lines: connect MyelinSurface directly to "
        "FibreRadialGrowth.")
      .add("SwellingAmplitude", &Options::swellingAmplitude, swellingAmplitudes,
        "How much larger than its mean an axon's radius is in a swelling of a lesion, as a fraction of that mean; 0: no "
        "swellings. Axons keep their volume, so they are thinner between swellings, and outer surfaces keep their place where "
        "myelin is whole, so an "
        "axon with a g-ratio g can swell by 1/g - 1 at most (0.43 for 0.7), less a wall of MinimumGap and four times the "
        "SurfaceTolerance. Axons without myelin do not swell. A larger "
        "amplitude has the same swellings. It needs the fibres' centre lines, as MyelinFollowsAxon does.")
      .add("SwellingSpacing", &Options::swellingSpacing, swellingSpacings,
        "Mean distance in µm of neighbouring swellings along an axon. Distances are gamma distributed, with a deviation of 0.45 "
        "of their mean. In a domain that is periodic along z, a whole number fits, on average as many.")
      .whereGiven("SwellingAmplitude")
      .add("SwellingLength", &Options::swellingLength, swellingLengths,
        "Length in µm over which a swelling is thicker than half of its height, at least eight voxels of FibreRadialGrowth.")
      .whereGiven("SwellingAmplitude")
      .add("NodeLength", &Options::nodeLength, nodeLengths,
        "Length in µm of nodes of Ranvier; 1 is usual, 0 makes none. In a node the fibre's outer surface comes down to the axon, "
        "up to a wall of MinimumGap and four times the SurfaceTolerance, and the space around it is left to the extra-axonal "
        "space. The g-ratio is then that of internodes. Nodes need the fibres' centre lines, as MyelinFollowsAxon does, and a "
        "GRatioModel other than TargetAxonVolumeFraction.")
      .add("InternodeFactor", &Options::internodeFactor, internodeFactors,
        "Length of internodes in outer diameters of the fibre (twice its TargetRadius), at least four ParanodeLengths. It is 100 "
        "to 200 in tissue. The first node of a fibre lies at a random place, the others follow at equal distances. In a domain "
        "that is periodic along z, distances change so that a whole number fits.")
      .whereGiven("NodeLength")
      .add("ParanodeLength", &Options::paranodeLength, paranodeLengths,
        "Length in µm of paranodes: on either side of a node, myelin and axon become as thick as in the internode over this "
        "length.")
      .whereGiven("NodeLength")
      .add("NodeConstriction", &Options::nodeConstriction, constrictions,
        "Diameter of the axon in a node, in parts of that in the internode. 1: the axon is not constricted.")
      .whereGiven("NodeLength")
      .add("NodeSeed", &Options::nodeSeed, limits::seed,
        "Seed of the nodes' places along the fibres, and of the internodes that InternodeLoss takes. The same seed gives a fibre "
        "the same nodes.")
      .whereGiven("NodeLength")
      .add("InternodeLoss", &Options::internodeLoss, limits::part,
        "Fraction of the internodes that have lost their myelin in a lesion. There the fibre's outer surface comes down to the "
        "axon "
        "as in a node, and the axon stays as it was. A larger fraction takes the same internodes and more. For whole fibres "
        "without "
        "myelin, see MyelinLoss of Lesion.")
      .whereGiven("NodeLength")
      .add("InternodeOrder", &Options::internodeOrder, { "Random", "Thinnest first" },
        "The internodes that lose their myelin first. Random: each is as likely as any other. Thinnest first: all of the fibre "
        "with the smallest TargetRadius, then of the next; of the last fibre some, at random.")
      .whereGiven("InternodeLoss")
      .add("RemyelinatedFraction", &Options::remyelinatedFraction, limits::part,
        "Fraction of the lost internodes whose myelin has come back, thinner than it was.")
      .whereGiven("InternodeLoss")
      .add("RemyelinatedGRatio", &Options::remyelinatedGRatio, remyelinated,
        "g-ratio of internodes whose myelin has come back; 0.85 is usual. Internodes whose g-ratio was higher are as they were.")
      .whereGiven("RemyelinatedFraction")
      .add("SmoothingIterations", &Options::smoothingIterations, limits::smoothingIterations,
        "Number of times that a fibre's depth is averaged over neighbouring voxels before its surface is contoured, at most 20. "
        "Smoothing rounds creases and keeps the gap between fibres; n steps blur by about the square root of n / 2 voxels. "
        "Fibres with a radius of two to four voxels are smoothed less, thinner ones not at all.")
      .advise("; more would blur fibres of few voxels away")
      .add("DecimationError", &Options::decimationError, limits::surfaceTolerance,
        "Distance in µm by which a surface may move to save triangles, judged by the field at points spread over it. "
        "LargestMove_um in the table is the largest error of the surface; it can be larger where the voxels do not resolve a "
        "crease. 0 keeps all triangles. It must not exceed the SurfaceTolerance of growth, which leaves room for it.")
      .add("MinimumAngle", &Options::minimumAngle, smallestAngles,
        "Smallest angle in degrees, 5 to 25, of nearly all triangles, for finite elements; 20 is usual. Surfaces then have even "
        "triangles, several times as many, which keep to DecimationError. 0: no smallest angle, and as few triangles as "
        "possible.")
      .add("ClipToDomain", &Options::clipToDomain,
        "Cut fibres off at the faces of the domain, and close them. If off, they reach to the end of the image, which is larger "
        "than the domain if growth was given a Margin.")
      .add("Seed", &Options::seed, limits::seed,
        "Seed of the fibres' g-ratios if GRatioModel is Distributed, and of the places of swellings. The same seed gives the "
        "same ones.");
  return list;
}

BeadShape MyelinSurfaceOptions::swellings() const
{
  const BeadShape healthy;
  return { this->swellingSpacing, healthy.spacingDeviation / healthy.spacing * this->swellingSpacing, this->swellingLength };
}

void validate(const MyelinSurfaceOptions& options)
{
  validateProperties(options);
  if (options.model == GRatioModel::Distributed)
  {
    distributedGRatio(options.gRatio, options.gRatioDeviation, 0, 1);
  }
  if (options.minimumAngle > 0.0 && options.decimationError == 0.0)
  {
    throw InvalidInput("MinimumAngle moves surfaces by up to DecimationError, which is 0: give it 0.005 µm, say");
  }
  if (options.swellingAmplitude > 0.0)
  {
    options.swellings().requireRoom(options.swellingAmplitude, "Swelling");
  }
  require(!options.hasNodes() || options.model != GRatioModel::TargetAxonVolumeFraction,
    "nodes of Ranvier are as deep as the g-ratio makes myelin, and the one for TargetAxonVolumeFraction depends on the outer "
    "surfaces with their nodes: choose another GRatioModel, or leave NodeLength at 0");
  if (options.model == GRatioModel::TargetAxonVolumeFraction && options.targetAxonVolumeFraction == 0.0)
  {
    throw InvalidInput(text("TargetAxonVolumeFraction is 0: give ", limits::fraction.lowest, " to ", limits::fraction.highest,
      " where GRatioModel is TargetAxonVolumeFraction"));
  }
}

void requireKnownGRatio(const Fibres& fibres, const MyelinSurfaceOptions& options)
{
  require(fibres.myelinFractions.empty() || options.model != GRatioModel::TargetAxonVolumeFraction,
    "where the fibres' MyelinFraction has taken myelin, the rest is as thick as the g-ratio makes it, and the one for "
    "TargetAxonVolumeFraction depends on the outer surfaces: choose another GRatioModel, or give the fibres no MyelinFraction");
}

double wallOfMyelin(const LabelImageFacts& facts)
{
  constexpr double room = 4.0; // in tolerances
  return std::max(facts.minimumGap, leastSeparation) + room * facts.surfaceTolerance;
}

LabelImageFacts labelImageFacts(const Fibres& fibres, const FibreRadialGrowthOptions& growth)
{
  LabelImageFacts facts;
  facts.domain = fibres.domain;
  facts.minimumGap = growth.minimumGap;
  facts.surfaceTolerance = growth.surfaceTolerance;
  facts.fibreIds = fibres.fibreIds;
  facts.bundleIds = fibres.bundleIds;
  facts.targetRadii = fibres.targetRadii;
  facts.columns = fibres.columns;
  return facts;
}

void requireDecimationRoom(const MyelinSurfaceOptions& options, double surfaceTolerance)
{
  if (options.decimationError > surfaceTolerance * (1.0 + 1e-9))
  {
    throw InvalidInput(text("DecimationError ", options.decimationError, " is more than the room of ", surfaceTolerance,
      " µm that growth left for moving surfaces: choose a smaller one, or raise SurfaceTolerance in FibreRadialGrowth"));
  }
}

} // namespace cactus
