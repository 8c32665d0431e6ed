// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/BandExcesses.h"
#include "mesh/CappedSurface.h"
#include "mesh/PlaneLoops.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// The loops of a surface in planes across it. All references have to outlive it.
struct LoopStack
{
  const CappedSurface& surface;
  const std::vector<Eigen::Vector3d>& places; ///< present places of the surface's points, µm
  Eigen::Index axis;                          ///< the axis across the planes
  const PlaneLoops& all;                      ///< the loops with all points
  const std::vector<PlaneLoop>& few;          ///< per plane, its loop with fewer points
  const BandExcesses& excesses;               ///< excess of the field over its level in the surface

  const Eigen::Vector3d& placeOf(std::int32_t point) const { return this->places[std::size_t(point)]; }
  std::uint8_t facesOf(std::int32_t point) const { return this->surface.faces[std::size_t(point)]; }
};

/// A part of a loop, from one of its points to another; indices continue past its end.
struct LoopLine
{
  const PlaneLoop* loop = nullptr;
  std::size_t at = 0;
  std::size_t end = 0;

  bool isAtEnd() const { return this->at == this->end; }
  std::int32_t point(std::size_t i) const { return this->loop->points[i % this->loop->points.size()]; }
  std::int32_t here() const { return this->point(this->at); }
  std::int32_t next() const { return this->point(this->at + 1); }
  std::int32_t last() const { return this->point(this->end); }
  LoopLine part(std::size_t from, std::size_t to) const { return { this->loop, from, to }; }
};

/// Returns the length (µm) of a line.
double lengthOf(const LoopStack& stack, const LoopLine& line);

/// Finds the part of the loop in a plane that lies between two edges: from the beginning of `lower` to that of `upper`, lines in
/// planes below and above, and from end to end. It has at least one point, and keeps off both edges by a fraction of the loop's
/// chords; if the loop with few points has none there, it is a point of the full loop. Returns false if there is none either, if
/// an edge meets the plane more than `farthest` (µm) away from the loop, or if an anchor lies between.
bool lineBetween(
  const LoopStack& stack, const LoopLine& lower, const LoopLine& upper, std::size_t plane, double farthest, LoopLine& found);

} // namespace cactus
