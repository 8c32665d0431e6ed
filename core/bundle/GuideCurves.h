// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/CurvedBundlesOptions.h"

#include <Eigen/Core>

#include <vector>

namespace cactus
{

/// The curve that a fibre of a curved bundle follows, in the x–z plane (µm).
struct GuideCurve
{
  int bundleId = 1;
  std::vector<Eigen::Vector2d> points; ///< x and z, in the sense of rising z
};

/// Returns the height (z) of the plane in which guide curves have the direction z and their places are given: the domain's
/// middle, or its lowest z for a fan.
double guideHeight(const CurvedBundlesOptions& options);

/// Returns the curve through a place (x, µm) of that plane, as far as it is within reachAlong() of the origin along z; without
/// points where no bundle is.
///
/// Curves of a bend are arcs about one axis. So are those of each of two kissing bundles, which fill the places up to kiss() from
/// x = 0 on both sides, and bend away from it. A curve of a fan is an arc up to the highest z, and then straight. Its angle there
/// is in proportion to its place within fanEntry(), up to half of fanAngle at both edges; places beyond an edge have curves
/// parallel to that of the edge. So neighbouring curves keep their distance everywhere except within a fan, where it widens.
GuideCurve guideCurve(const CurvedBundlesOptions& options, double place);

/// Returns the largest distance from x = 0 of the place of a curve that enters the domain with its margin.
double farthestPlace(const CurvedBundlesOptions& options);

/// Returns the fraction of the domain that fibres fill which fill the whole plane of guideHeight(), where there are bundles, and
/// keep their thickness along their curves.
double bundlesShare(const CurvedBundlesOptions& options);

} // namespace cactus
