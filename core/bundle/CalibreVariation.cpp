// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/CalibreVariation.h"

#include "base/Limits.h"

#include <limits>

namespace cactus
{

const PropertyList<CalibreVariation>& CalibreVariation::properties()
{
  using Options = CalibreVariation;
  static const auto list =
    PropertyList<Options>()
      .add("CalibreVariation", &Options::deviation, limits::calibreVariation,
        "Variation of a fibre's calibre along it: standard deviation of the logarithm of the axon's (inner) radius, on average "
        "over the fibres; thick fibres vary less. Axons of the corpus callosum have 0.25 (human) to 0.3 (mouse). The myelin is "
        "as thick along the whole fibre, so that the outer radius varies 0.7 times as much for a g-ratio of 0.7. TargetRadius "
        "is the root mean square of a fibre's outer radius. Neighbours alone give fibres that fill 0.9 a variation of 0.15, and "
        "less cannot be had there. Axons of up to 0.2 µm do not vary, since their necks could not be resolved. 0: fibres are as "
        "thick everywhere before they grow.")
      .add("CalibreCorrelationLength", &Options::correlationLength, limits::calibreCorrelationLength,
        "Length in µm along the fibre over which its calibre is similar: the correlation falls to one half at 0.97 times this "
        "length. Axons have 1.2 to 1.5. Control points are at most 0.6 times this length apart.")
      .whereGiven("CalibreVariation");
  return list;
}

double longestSpacing(const CalibreVariation& variation)
{
  // Distance of control points, in correlation lengths.
  constexpr double sampling = 0.6;
  return variation.varies() ? sampling * variation.correlationLength : std::numeric_limits<double>::infinity();
}

} // namespace cactus
