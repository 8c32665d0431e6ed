// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "bundle/Streamlines.h"
#include "bundle/TractFibresOptions.h"
#include "fibres/Fibres.h"

#include <Eigen/Core>

#include <cstddef>

namespace cactus
{

/// Result of layTractFibres().
struct TractFibresReport
{
  std::size_t streamlines = 0;      ///< number of streamlines that fibres follow
  double bundleDiameter = 0.0;      ///< µm
  double fibreVolumeFraction = 0.0; ///< volume of the capsules in the domain over the domain's volume
  double smoothing = 0.0;           ///< µm: standard deviation of the widest Gaussian used to round off a bend; 0 for none
  int ends = 0;                     ///< number of streamline ends within the domain, beyond which the path continues straight
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(); ///< middle of the domain, in the streamlines' unit
};

/// Lays a bundle of parallel fibres around each chosen streamline (see chooseStreamlines()), scaled and moved so that the middle
/// is the origin. Axes keep their directions.
///
/// Circles of the sampled radii are packed without overlap to the requested density, like those on a bundle's face (see
/// initialiseBundles()). Those nearest to the path are kept, until their area is the requested fraction of a disc of the bundle's
/// diameter, and each is carried along the path in a frame that does not twist (see TractPath). If no bend of the path has a
/// radius below 1.1 times the disc's, fibres of one bundle keep their distances and do not overlap; a path with sharper bends is
/// rounded off first. Bundles of several streamlines may overlap, which CapsuleOptimizer resolves. A fibre reaches beyond the
/// domain with its margin by its own (target) radius; fibres that do not come so near are left out. For one bundle that covers
/// the domain, packing is repeated until the capsules' volume in the domain is within 1 % of the one asked for, or as near as can
/// be.
///
/// BundleId is that of the streamline; without one, streamlines are counted from 1, the nearest to the middle first.
/// grownFraction is that of the options in proportion to the bundles' fraction of the domain.
///
/// Throws InvalidInput (see validate of both arguments), Infeasible if the density cannot be met, a path cannot be followed or
/// overlapping bundles would fill more than the domain, OutOfMemory, Cancelled. Gives the same bits on any number of threads.
Fibres layTractFibres(const Streamlines& streamlines, const TractFibresOptions& options, const Context& context = {},
  TractFibresReport* report = nullptr);

} // namespace cactus
