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

/// What came of it.
struct TractFibresReport
{
  std::size_t streamlines = 0;      ///< that fibres follow
  double bundleDiameter = 0.0;      ///< µm
  double fibreVolumeFraction = 0.0; ///< of the domain: volume of the capsules in it over its own
  double smoothing = 0.0; ///< µm: standard deviation of the widest Gaussian that a bend had to be rounded off with; 0 for none
  int ends = 0;           ///< of streamlines within the domain, from where they were carried on straight
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(); ///< where the domain's middle lies, in the streamlines' unit
};

/// Lays a bundle of parallel fibres around each of the streamlines that are chosen (see chooseStreamlines()), scaled and moved so
/// that the middle is the origin. Axes stay as they are.
///
/// Circles of the sampled radii are packed without overlap to the density asked for, as those on a bundle's face are (see
/// initialiseBundles()); those nearest to the path are kept, until their area is the part asked of a disc of the bundle's
/// diameter, and each is carried along the path in a frame that does not twist (see TractPath). Where the path bends nowhere more
/// sharply than 1.1 times the disc's radius, fibres of one bundle keep their distances, and none overlap; a path that does is
/// rounded off first. Bundles of several streamlines may overlap, which is undone by CapsuleOptimizer. A fibre reaches as far
/// beyond the domain with its margin as its own (target) radius, and those that do not come so near are left out.
///
/// BundleId is that of the streamline, or where there is none counts the streamlines from 1, the nearest to the middle first.
/// grownFraction is that of the options in proportion to what the bundles fill of the domain.
///
/// Throws InvalidInput (see validate of both arguments), Infeasible where the density cannot be met, a path cannot be followed or
/// overlapping bundles would fill more than there is, OutOfMemory, Cancelled. Same bits on any number of threads.
Fibres layTractFibres(const Streamlines& streamlines, const TractFibresOptions& options, const Context& context = {},
  TractFibresReport* report = nullptr);

} // namespace cactus
