// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"

namespace cactus
{

/// Distance between the control points of a fibre. A capsule chain bends once per control point, so the spacing limits how
/// sharply a fibre can bend; longer capsules are cheaper.
struct ControlPointSpacing
{
  double factor = 1.25; ///< multiple of the fibre's radius, within the two limits
  double minimum = 0.8; ///< µm
  double maximum = 2.0; ///< µm

  static const PropertyList<ControlPointSpacing>& properties();
  /// Throws InvalidInput, naming the properties, if the limits exclude each other.
  void validate() const;
  /// Returns the distance (µm) for a fibre of this radius.
  double of(double radius) const;
};

} // namespace cactus
