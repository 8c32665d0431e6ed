// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/TractFibresOptions.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// Polylines in any unit: streamline s owns the points [offsets[s], offsets[s + 1]).
struct Streamlines
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::size_t> offsets{ 0 }; ///< size() + 1 entries
  std::vector<int> bundleIds;            ///< one per streamline, positive; empty if unknown

  std::size_t size() const { return offsets.size() - 1; }
  std::size_t pointCount(std::size_t streamline) const { return offsets[streamline + 1] - offsets[streamline]; }
};

/// Throws InvalidInput, naming streamline and point (both counted from 1), unless there is a streamline and each has two points
/// or more with finite coordinates of reasonable size, not all in one place.
void validate(const Streamlines& streamlines);

/// The point on a streamline that is nearest to a given position.
struct StreamlinePlace
{
  std::size_t streamline = 0;
  std::size_t segment = 0; ///< index of the point at its beginning
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double distance = 0.0;
};

/// The position of the domain, and the chosen streamlines.
struct StreamlineChoice
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  /// The nearest place to the middle on each chosen streamline, the nearest streamline first.
  std::vector<StreamlinePlace> places;
};

/// Chooses the streamlines that the options select. The middle is the nearest place on them to the requested point, or to the
/// mean of their half-way points. The requested number of streamlines nearest to the middle is kept, none of them farther than
/// `reach`, in the unit of the points. Precondition: validate(streamlines). Throws InvalidInput if none is selected.
StreamlineChoice chooseStreamlines(const Streamlines& streamlines, const TractFibresOptions& options, double reach);

} // namespace cactus
