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
  std::size_t middle = 0;            ///< index of the sample nearest to the domain's middle, on the streamline itself
  std::vector<Eigen::Vector3d> ends; ///< ends of the streamline, beyond which the stretch continues straight
};

/// Returns the stretch around a place of a streamline until it is `far` (µm) from the origin, on both sides; beyond the end of a
/// streamline it continues straight. Points are moved by -middle and multiplied by `scale`. Samples are `spacing` apart, or wider
/// so that there are one or two thousand.
TractStretch stretchAround(const Streamlines& streamlines, const StreamlinePlace& place, const Eigen::Vector3d& middle,
  double scale, double far, double spacing);

/// Rounds off every bend sharper than a radius (µm), and changes nothing if there is none. The deviations from the chord are
/// smoothed by a Gaussian over the length, with the ends held: the narrowest of a series that suffices. Returns its standard
/// deviation (µm), or 0 without a change. Throws Infeasible for a stretch that comes back to within that radius of its beginning.
double roundOff(TractStretch& stretch, double radius);

/// Moves a rounded stretch so that its middle is the origin again, and continues it straight to `far` (µm) from there.
void bringToOrigin(TractStretch& stretch, double far);

/// Returns the length of a polyline.
double lengthOf(const std::vector<Eigen::Vector3d>& line);

/// Returns the smallest radius (µm) of the circles through three consecutive samples; infinite for a straight line.
double smallestBend(const std::vector<Eigen::Vector3d>& points);

/// A line with a frame of axes across it that minimises rotation about it (W. Wang et al., Computation of rotation minimizing
/// frames, ACM Trans. Graph. 27, 2008: double reflection). A point that is carried along with fixed coordinates in this frame
/// keeps its distance from the line and runs parallel to it.
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

/// Returns the part of a stretch whose cross-sections, discs of a radius (µm), can meet a ball of radius `reach` (µm) about the
/// origin.
TractPath pathThrough(const TractStretch& stretch, double reach, double radius);

} // namespace cactus
