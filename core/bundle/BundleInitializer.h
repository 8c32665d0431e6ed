// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "bundle/BundleInitializerOptions.h"
#include "fibres/Fibres.h"

namespace cactus
{

/// What came of it, over all bundles.
struct BundleInitializerReport
{
  double fibreVolumeFraction = 0.0; ///< as the option of that name measures it
  double meanDispersion = 0.0;      ///< degrees, to the nominal axes
};

/// One bundle along +z, or two crossing in the x–z plane at ±crossingAngle/2 from +z: fibres, each with its sampled
/// radius, whose circles do not overlap on either end face and lie wholly inside it. Between the faces fibres may overlap;
/// undoing that is CapsuleOptimizer's part.
///
/// The radii are drawn until the density is met (see drawRadii). On the first face circles are placed largest first and
/// relaxed (see CircleRelaxation.h). With DispersionModel::Coherent a random flow (see CoherentFlow.h) then carries their middles
/// to the opposite face, and fibres go the way that it leads them, so that they are as dense amid the bundle as at its ends. Else
/// they are straight; each draws its angle from the dispersion model, and its end is placed on the ring that this angle leaves on
/// the opposite face, at the first of several random azimuths that is free, or least crowded. These circles are relaxed too.
/// Their displacements are rescaled, and relaxed again, until the mean angle is within 0.05° (and 2 %) of meanDispersion and, as
/// far as that is possible (usually to 0.1°), the mean direction is the axis. A fibre is never left out.
///
/// The faces of a single bundle are z = ±side/2, exactly. A crossing bundle's faces bound a cuboid that covers the whole domain
/// (and margin) and is divided into the layers of its crossing style along y.
///
/// Throws InvalidInput (see validate; also where the largest fibre does not fit), Infeasible with the value reached where density
/// or dispersion cannot be met, OutOfMemory, Cancelled. Same bits on any number of threads.
Fibres initialiseBundles(
  const BundleInitializerOptions& options, const Context& context = {}, BundleInitializerReport* report = nullptr);

} // namespace cactus
