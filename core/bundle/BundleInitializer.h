// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "bundle/BundleInitializerOptions.h"
#include "fibres/Fibres.h"

#include <cstddef>

namespace cactus
{

/// Result of initialiseBundles(), over all bundles.
struct BundleInitializerReport
{
  double fibreVolumeFraction = 0.0; ///< measured as for the option of that name
  double meanDispersion = 0.0;      ///< degrees, measured as for the option of that name, relative to the nominal axes
  double sinuosity = 0.0;           ///< of the fibres in the domain, with a stationary flow
  std::size_t layers = 0;           ///< of two bundles that lie in layers
};

/// Makes one bundle along a direction, or two crossing in the x–z plane at ±crossingAngle/2 from +z: fibres, each with its
/// sampled radius. Fibres may overlap; CapsuleOptimizer resolves that.
///
/// The radii are drawn until the density is met (see drawRadii). On one plane circles are placed largest first and relaxed (see
/// CircleRelaxation.h).
///
/// Border::Cut, unless bundles have layers: this plane is in the middle of each bundle, across its axis, and the bundle is larger
/// than the domain (see surroundings()). Two bundles are made one after the other, each with half of the fractions.
/// With DispersionModel::Coherent a stationary random flow (see StationaryFlow.h) carries the circles' centres both ways, and
/// fibres follow its paths. With the other models fibres are straight, and each passes through its circle at an angle from the
/// model. Packing is repeated until the capsules' volume in the domain is within 1 % of the one asked for.
///
/// DispersionModel::Harmonics and Peaks: see layLinesInSpace().
///
/// Border::Walls, or layers: the plane is the first face, and circles lie wholly inside both end faces and do not overlap
/// there. With Coherent a random flow within the walls (see CoherentFlow.h) carries the centres to the opposite face. With the
/// other models each fibre draws its angle from the model, and its end is placed on the ring that this angle gives on the
/// opposite face, at the first of several random azimuths that is free, or least crowded. These circles are relaxed too. Their
/// displacements are rescaled, and relaxed again, until the mean angle is within 0.05° (and 2 %) of meanDispersion and, as far as
/// possible (usually to 0.1°), the mean direction is the axis. A fibre is never left out.
///
/// With walls the faces of a single bundle are those of the domain, exactly. A crossing bundle's faces bound a cuboid that covers
/// the whole domain (and margin) and is divided into the layers of its crossing style along y.
///
/// Throws InvalidInput (see validate; also if the largest fibre does not fit), Infeasible with the value reached if density or
/// dispersion cannot be met, OutOfMemory, Cancelled. Gives the same bits on any number of threads.
Fibres initialiseBundles(
  const BundleInitializerOptions& options, const Context& context = {}, BundleInitializerReport* report = nullptr);

} // namespace cactus
