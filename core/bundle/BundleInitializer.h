// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "bundle/BundleInitializerOptions.h"
#include "fibres/Fibres.h"

namespace cactus
{

/// Result of initialiseBundles(), over all bundles.
struct BundleInitializerReport
{
  double fibreVolumeFraction = 0.0; ///< measured as for the option of that name
  double meanDispersion = 0.0;      ///< degrees, measured as for the option of that name, relative to the nominal axes
  double sinuosity = 0.0;           ///< of the fibres in the domain, with a stationary flow
};

/// Makes one bundle along +z, or two crossing in the x–z plane at ±crossingAngle/2 from +z: fibres, each with its sampled radius,
/// whose circles lie wholly inside both end faces and do not overlap there. Between the faces fibres may overlap;
/// CapsuleOptimizer resolves that.
///
/// The radii are drawn until the density is met (see drawRadii). On the first face circles are placed largest first and relaxed
/// (see CircleRelaxation.h). With DispersionModel::Coherent a random flow (see CoherentFlow.h) then carries their centres to the
/// opposite face, and fibres follow its paths, so that they are as dense in the middle of the bundle as at its ends. With the
/// other models fibres are straight: each draws its angle from the model, and its end is placed on the ring that this angle gives
/// on the opposite face, at the first of several random azimuths that is free, or least crowded. These circles are relaxed too.
/// Their displacements are rescaled, and relaxed again, until the mean angle is within 0.05° (and 2 %) of meanDispersion and, as
/// far as possible (usually to 0.1°), the mean direction is the axis. A fibre is never left out.
///
/// The faces of a single bundle are z = ±side/2, exactly, unless the margin is to be as wide as needed. A crossing bundle's faces
/// bound a cuboid that covers the whole domain (and margin) and is divided into the layers of its crossing style along y.
///
/// Throws InvalidInput (see validate; also if the largest fibre does not fit), Infeasible with the value reached if density or
/// dispersion cannot be met, OutOfMemory, Cancelled. Gives the same bits on any number of threads.
Fibres initialiseBundles(
  const BundleInitializerOptions& options, const Context& context = {}, BundleInitializerReport* report = nullptr);

} // namespace cactus
