// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/Streamlines.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// A stretch of a streamline in the substrate's space (µm), evenly sampled.
struct TractStretch
{
  std::vector<Eigen::Vector3d> points;
  std::size_t middle = 0;            ///< the sample that is nearest to the domain's middle, on the streamline itself
  std::vector<Eigen::Vector3d> ends; ///< of the streamline, where it was carried on straight
};

/// The stretch around a place of a streamline until it is `far` (µm) from the origin, on both sides; a streamline that ends
/// before is carried on straight. Points are moved by -middle and multiplied by `scale`. Samples are `spacing` apart, or so that
/// there are a thousand or two.
TractStretch stretchAround(const Streamlines& streamlines, const StreamlinePlace& place, const Eigen::Vector3d& middle,
  double scale, double far, double spacing);

/// Rounds off every bend sharper than a radius (µm), and changes nothing where there is none: the deviations from the chord are
/// smoothed by a Gaussian over the length, the narrowest of a series that does, with the ends held. Returns its standard
/// deviation (µm), 0 where nothing was done. Throws Infeasible for a stretch that comes back to within that
/// radius of where it began.
double roundOff(TractStretch& stretch, double radius);

/// Moves what was rounded off so that its middle is the origin again, and carries it on straight to `far` (µm) from there.
void bringToOrigin(TractStretch& stretch, double far);

/// Length of a polyline.
double lengthOf(const std::vector<Eigen::Vector3d>& line);

/// Smallest radius (µm) of the circles through three consecutive samples; infinite for a straight line.
double smallestBend(const std::vector<Eigen::Vector3d>& points);

/// A line with axes across it that turn about it no more than they must (W. Wang et al., Computation of rotation minimizing
/// frames, ACM Trans. Graph. 27, 2008: double reflection). A point that is carried along with fixed coordinates in these axes
/// keeps its distance from the line and runs in parallel to it.
struct TractPath
{
  std::vector<Eigen::Vector3d> points; ///< µm
  std::vector<Eigen::Vector3d> u;      ///< first axis across, unit vectors
  std::vector<Eigen::Vector3d> v;      ///< second axis across, unit vectors

  Eigen::Vector3d beside(std::size_t sample, const Eigen::Vector2d& offset) const
  {
    return points[sample] + offset.x() * u[sample] + offset.y() * v[sample];
  }
};

/// The part of a stretch whose cross-sections, discs of a radius (µm), can meet a ball of radius `reach` (µm) about the origin.
TractPath pathThrough(const TractStretch& stretch, double reach, double radius);

} // namespace cactus
