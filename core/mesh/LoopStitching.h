// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/LoopLines.h"
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

/// A range of the field's excess over its level, µm.
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

/// Triangles all around between two loops.
struct StitchedLoops
{
  std::vector<std::array<std::int32_t, 3>> triangles;
  /// Per triangle, the field's excess over its level (µm) in its middle, and on the edge to the next triangle.
  std::vector<std::array<double, 2>> errors;
};

/// Stitches loops in two planes of a surface together.
class LoopStitching
{
public:
  /// Uses the options' field, level and maximumError. All arguments have to outlive the object.
  LoopStitching(const LoopStack& stack, const SurfaceDecimationOptions& options)
    : Stack(stack)
    , Options(options)
  {
  }

  /// Fills the ring between a loop in plane `begin` and one above it in plane `end`. Each step takes the shorter of two edges,
  /// unless only the other one is within maximumError of the level.
  ///
  /// If the field's error is too large in the middle of a triangle or at points along a crossing edge, or if triangles fold, a
  /// part of the loop midway is inserted, from the stack's loops with few points; and so on down to single bands. There, and
  /// everywhere if `isLoose`, the surface may lie farther inside. On faces of the box the field may be larger.
  ///
  /// Returns false if that does not help, or if the two loops do not meet the same faces of the box in the same order.
  bool stitch(const PlaneLoop& lower, const PlaneLoop& upper, std::size_t begin, std::size_t end, bool isLoose,
    StitchedLoops& result) const;

private:
  /// The planes of two lines, and whether larger errors are allowed between them.
  struct Span
  {
    std::size_t begin;
    std::size_t end;
    bool isLoose;

    std::size_t bands() const { return this->end - this->begin; }
    std::size_t middle() const { return (this->begin + this->end) / 2; }
  };
  /// An edge between these places of two lines, and the triangle behind it.
  struct Crossing
  {
    std::size_t lower;
    std::size_t upper;
    double error;          ///< along the edge, µm
    double inMiddle = 0.0; ///< of the triangle, µm
    bool isFolded = false; ///< against the previous triangle
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    std::int32_t tip = -1; ///< the triangle's corner opposite the edge
  };
  /// Two lines, and all triangles between them.
  struct Crossed
  {
    LoopLine lower;
    LoopLine upper;
    Span span;
    Eigen::Vector3d offset; ///< from the lower line to the upper one, µm
    int parts;              ///< number of parts of a crossing edge between the points at which the field is evaluated
    ErrorRange allowed;
    std::vector<Crossing> crossings; ///< one more than triangles

    std::size_t triangles() const { return this->crossings.size() - 1; }
    bool isGoodEdge(std::size_t i) const { return this->allowed.holds(this->crossings[i].error); }
    bool isGood(std::size_t i) const { return this->allowed.holds(this->crossings[i].inMiddle) && !this->crossings[i].isFolded; }
  };
  /// Crossings of triangles that are to be replaced, between edges that stay.
  struct Part
  {
    std::size_t begin;
    std::size_t end;
  };

  Eigen::Vector3d middleOf(const PlaneLoop& loop) const;
  bool isInFace(const PlaneLoop& loop, std::size_t anchor) const;
  static LoopLine behindAnchor(const PlaneLoop& loop, std::size_t anchor);
  std::pair<std::size_t, std::size_t> nearestPair(
    const PlaneLoop& lower, const PlaneLoop& upper, const Eigen::Vector3d& offset) const;
  bool matchAnchors(const PlaneLoop& lower, const PlaneLoop& upper, const Eigen::Vector3d& offset, std::size_t& found) const;
  bool stitchRing(
    const PlaneLoop& lower, const PlaneLoop& upper, const Span& span, const Eigen::Vector3d& offset, StitchedLoops& result) const;
  ErrorRange allowedIn(const Span& span) const;
  Crossed cross(const LoopLine& lower, const LoopLine& upper, const Span& span, const Eigen::Vector3d& offset,
    Eigen::Vector3d before = Eigen::Vector3d::Zero()) const;
  bool goesBelow(const LoopLine& lower, const LoopLine& upper, const Crossed& demand, double& error) const;
  bool fill(const Crossed& crossed, StitchedLoops& result) const;
  bool mend(const Crossed& crossed, std::size_t bad, std::size_t& done, StitchedLoops& result) const;
  void widen(const Crossed& crossed, std::size_t done, Part& part) const;
  bool refine(const Crossed& crossed, const Part& part, StitchedLoops& result) const;
  bool fillBetween(
    const LoopLine& lower, const LoopLine& upper, const Span& span, const Eigen::Vector3d& outwards, StitchedLoops& result) const;
  static void keep(const Crossed& crossed, std::size_t begin, std::size_t end, StitchedLoops& result);
  bool addTriangle(const std::array<std::int32_t, 3>& triangle, const Eigen::Vector3d& outwards, const ErrorRange& allowed,
    StitchedLoops& result) const;
  Eigen::Vector3d normalOf(const std::array<std::int32_t, 3>& triangle) const;
  double errorAlong(std::int32_t lower, std::int32_t upper, int parts) const;
  double errorIn(const std::array<std::int32_t, 3>& triangle) const;
  double errorAt(const Eigen::Vector3d& p) const { return this->Options.field(p) - this->Options.level; }

  const LoopStack& Stack;
  const SurfaceDecimationOptions& Options;
};

} // namespace cactus
