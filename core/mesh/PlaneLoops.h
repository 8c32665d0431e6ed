// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Consecutive points of a surface in one plane, counterclockwise as seen from the upper end of the axis.
struct PlaneLoop
{
  std::vector<std::int32_t> points;
  /// Indices in `points` at which the loop meets or leaves a face of the box. The loop begins at the first one or, without any,
  /// at the point farthest from its middle.
  std::vector<std::size_t> anchors;

  bool isEmpty() const { return points.empty(); }
};

/// The loops of a contour in planes of its lattice across an axis, and the bands between the planes. Band b lies between planes b
/// and b + 1.
class PlaneLoops
{
public:
  /// `planes` (µm, increasing, at least four) are those of contour()'s lattice across the axis, all evenly spaced but the
  /// outermost two. These contain the caps, which belong to the first and the last band.
  PlaneLoops(const CappedSurface& surface, Eigen::Index axis, const std::vector<double>& planes);

  std::size_t planeCount() const { return this->Loops.size(); }
  std::size_t bandCount() const { return this->IsRing.size(); }
  /// Returns the loop in a plane, which in the outermost ones is the rim of the caps; empty if there is none or more than one.
  const PlaneLoop& loop(std::size_t plane) const { return this->Loops[plane]; }
  /// Tells whether a band, without caps, is a ring from a loop() to the next one: its Euler characteristic is 0, and it meets the
  /// two planes nowhere else.
  bool isRing(std::size_t band) const { return this->IsRing[band]; }
  std::size_t bandOf(std::size_t triangle) const { return this->Bands[triangle]; }

private:
  void placePoints(const CappedSurface& surface, Eigen::Index axis, const std::vector<double>& planes);
  void sortTriangles(const CappedSurface& surface);
  void findLoops(const CappedSurface& surface);
  void findRings();

  std::vector<int> Levels;            ///< per point: 2 p in plane p, 2 p + 1 between that and the next one
  std::vector<std::size_t> Counts;    ///< number of points per level; in the outermost planes only those of rims
  std::vector<std::int32_t> Next;     ///< per point, the next one in its plane, or -1
  std::vector<std::size_t> Bands;     ///< per triangle
  std::vector<std::size_t> Triangles; ///< per band, the number that are no caps in its planes
  std::vector<PlaneLoop> Loops;       ///< per plane
  std::vector<bool> IsRing;           ///< per band
};

} // namespace cactus
