// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/PlaneLoops.h"
#include "mesh/SurfaceDecimation.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cactus
{

/// By how much a field may exceed its level, or does so, µm.
struct ErrorRange
{
  double lowest = 0.0;
  double highest = 0.0;

  void add(double error)
  {
    lowest = std::min(lowest, error);
    highest = std::max(highest, error);
  }
  bool holds(double error) const { return error >= this->lowest && error <= this->highest; }
  double middle() const { return 0.5 * (lowest + highest); }
};

/// Triangles between two loops, all around.
struct StitchedLoops
{
  std::vector<std::array<std::int32_t, 3>> triangles;
  /// Of each triangle, by how much the field exceeds its level (µm) in its middle, and on the edge to the next triangle.
  std::vector<std::array<double, 2>> errors;
};

/// Stitches loops in two planes of a surface together.
class LoopStitching
{
public:
  /// `places` are where points of the surface are (µm); of the options field, level and maximumError count. What is given has to
  /// outlive the object.
  LoopStitching(const CappedSurface& surface, const std::vector<Eigen::Vector3d>& places, const SurfaceDecimationOptions& options)
    : Surface(surface)
    , Places(places)
    , Options(options)
  {
  }

  /// Fills the ring between a loop and one above it. The shorter of two edges goes across, unless only the other one is within
  /// maximumError of the level. Returns false where what the field is more than its level is not `allowed` in the middle of a
  /// triangle or at those points of an edge across that cut it into `parts`; where triangles would fold; and where the two loops
  /// do not come to the same faces of the box, one after the other. On faces of the box the field may be larger.
  bool stitch(const PlaneLoop& lower, const PlaneLoop& upper, int parts, const ErrorRange& allowed, StitchedLoops& result) const;

private:
  /// A part of a loop, from one of its points to another, counted on past its end.
  struct Line
  {
    const PlaneLoop& loop;
    std::size_t at;
    std::size_t end;

    bool isAtEnd() const { return at == end; }
    std::int32_t here() const { return loop.points[at % loop.points.size()]; }
    std::int32_t next() const { return loop.points[(at + 1) % loop.points.size()]; }
  };
  /// What is asked of triangles between two loops, the upper of which is so far (µm) from the lower one.
  struct Demand
  {
    Eigen::Vector3d offset;
    int parts;
    ErrorRange allowed;
  };

  const Eigen::Vector3d& placeOf(std::int32_t point) const { return this->Places[std::size_t(point)]; }
  std::uint8_t facesOf(std::int32_t point) const { return this->Surface.faces[std::size_t(point)]; }
  Eigen::Vector3d middleOf(const PlaneLoop& loop) const;
  bool isInFace(const PlaneLoop& loop, std::size_t anchor) const;
  static Line behindAnchor(const PlaneLoop& loop, std::size_t anchor);
  std::pair<std::size_t, std::size_t> nearestPair(
    const PlaneLoop& lower, const PlaneLoop& upper, const Eigen::Vector3d& offset) const;
  bool matchAnchors(const PlaneLoop& lower, const PlaneLoop& upper, const Eigen::Vector3d& offset, std::size_t& found) const;
  bool stitchLines(Line lower, Line upper, const Demand& demand, StitchedLoops& result) const;
  bool goesBelow(const Line& lower, const Line& upper, const Demand& demand, double& error) const;
  double errorAlong(std::int32_t lower, std::int32_t upper, int parts) const;
  double errorIn(const std::array<std::int32_t, 3>& triangle) const;
  double errorAt(const Eigen::Vector3d& p) const { return this->Options.field(p) - this->Options.level; }

  const CappedSurface& Surface;
  const std::vector<Eigen::Vector3d>& Places;
  const SurfaceDecimationOptions& Options;
};

} // namespace cactus
