// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/ControlPointSpacing.h"

#include "base/Error.h"
#include "base/Limits.h"

#include <algorithm>

namespace cactus
{

const PropertyList<ControlPointSpacing>& ControlPointSpacing::properties()
{
  using Options = ControlPointSpacing;
  static const auto list =
    PropertyList<Options>()
      .add("SpacingFactor", &Options::factor, limits::spacingFactor,
        "Distance between a fibre's control points as a multiple of its radius, within the two limits below.")
      .add("MinimumSpacing", &Options::minimum, limits::spacing,
        "Smallest distance between control points in µm. A larger one makes large substrates cheaper; a smaller one lets thin "
        "fibres bend more sharply.")
      .add("MaximumSpacing", &Options::maximum, limits::spacing, "Largest distance between control points in µm.");
  return list;
}

void ControlPointSpacing::validate() const
{
  if (minimum > maximum)
  {
    throw InvalidInput(text("MaximumSpacing ", maximum, " is below MinimumSpacing ", minimum, ": exchange them"));
  }
}

double ControlPointSpacing::of(double radius) const
{
  return std::clamp(factor * radius, minimum, maximum);
}

} // namespace cactus
