// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/CalibreVariation.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Numbers.h"

#include <limits>

namespace cactus
{

const PropertyList<CalibreVariation>& CalibreVariation::properties()
{
  using Options = CalibreVariation;
  static const auto list =
    PropertyList<Options>()
      .add("CalibreModel", &Options::model, { "Lognormal", "Beads" },
        "How a fibre's calibre varies along it. Lognormal: swellings and necks of all sizes (CalibreVariation), as in healthy "
        "white matter. Beads: swellings of one size (BeadAmplitude, BeadSpacing, BeadLength), with the same radius in between, "
        "as in injured axons. In both, TargetRadius is the root mean square of a fibre's outer radius, and the myelin is as "
        "thick "
        "along the whole fibre.")
      .add("CalibreVariation", &Options::deviation, limits::calibreVariation,
        "Variation of a fibre's calibre along it: standard deviation of the logarithm of the axon's (inner) radius, on average "
        "over the fibres; thick fibres vary less. Axons of the corpus callosum have 0.25 (human) to 0.3 (mouse). The myelin is "
        "as thick along the whole fibre, so that the outer radius varies 0.7 times as much for a g-ratio of 0.7. TargetRadius "
        "is the root mean square of a fibre's outer radius. Neighbours alone give fibres that fill 0.9 a variation of 0.15, and "
        "less cannot be had there. Thin axons vary less, so that voxels resolve their necks: of 0.1 µm those of axons with "
        "myelin, which do not vary up to 0.2 µm, and of 0.05 µm those of axons without. 0: fibres are as thick everywhere before "
        "they grow.")
      .where("CalibreModel", { 0 })
      .add("CalibreCorrelationLength", &Options::correlationLength, limits::calibreCorrelationLength,
        "Length in µm along the fibre over which its calibre is similar: the correlation falls to one half at 0.97 times this "
        "length. Axons have 1.2 to 1.5. Control points are at most 0.6 times this length apart.")
      .whereGiven("CalibreVariation")
      .where("CalibreModel", { 0 })
      .add("BeadAmplitude", &Options::beadAmplitude, limits::beadAmplitude,
        "How much thicker than on average an axon is in a bead: largest over mean inner radius, minus 1. Axons of the mouse have "
        "0.6. Thin axons have less where the necks between their beads could not be resolved. 0: fibres are as thick everywhere "
        "before they grow.")
      .where("CalibreModel", { 1 })
      .include(&Options::beads, BeadShape::properties())
      .add("SectionAxisRatio", &Options::sectionAxisRatio, limits::sectionAxisRatio,
        "How far the sections of axons are from round: minor over major axis of the ellipse with the section's second moments, "
        "on average over the final inner surfaces. Axons of the corpus callosum have 0.76 (mouse) to 0.84 (monkey). Growth seeds "
        "the fibres so, in directions that turn at random along each of them. As they grow, neighbours flatten each other, by "
        "themselves to 0.93 where fibres fill 0.7, 0.84 at 0.9, 0.81 at 0.95; a larger ratio cannot be had there, so the default "
        "has an effect below 0.89 only. Fibres of more than 0.7 µm are rounder. 1: growth alone shapes them.")
      .add("GRatio", &Options::gRatio, limits::gRatioOrNone,
        "g-ratio of these fibres (diameter of the axon over that of the fibre), whatever MyelinSurface says of the others, so "
        "that each of several bundles can have its own. They carry it as TargetGRatio; axons without myelin keep 1. 0: "
        "MyelinSurface's GRatioModel.");
  return list;
}

void CalibreVariation::validate() const
{
  if (this->model == CalibreModel::Beads)
  {
    this->beads.requireRoom(this->beadAmplitude, "Bead");
  }
}

double longestSpacing(const CalibreVariation& variation)
{
  // Distances of control points.
  constexpr double ofCorrelationLength = 0.6;
  constexpr double ofBeadLength = 0.4;
  if (!variation.varies())
  {
    return std::numeric_limits<double>::infinity();
  }
  return variation.model == CalibreModel::Lognormal ? ofCorrelationLength * variation.correlationLength
                                                    : ofBeadLength * variation.beads.length;
}

} // namespace cactus
