// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// Fibres with about every second of their control points, and what becomes of the others when these have moved. Each fibre for
/// itself, so that it does not matter which others there are.
class CoarseFibres
{
public:
  /// A control point is left out where the one before it is kept and the fibre runs nearly straight from that to the next. Ends
  /// are kept, and no segment has zero length where none had before.
  explicit CoarseFibres(const Fibres& fine);

  const Fibres& fibres() const { return this->Coarse; }

  /// Values at all control points of the fine fibres, given those at the control points of the coarse ones, which keep theirs:
  /// a cubic between each two, continuous in its first derivative (Catmull and Rom 1974). Exact where values grow evenly from
  /// each control point to the next.
  std::vector<Eigen::Vector3d> interpolate(const std::vector<Eigen::Vector3d>& values) const;

  /// Where the control points of the fine fibres are when those of the coarse ones have gone to `moved`: `fine`, as they were,
  /// displaced as their neighbours along the fibre are.
  std::vector<Eigen::Vector3d> refine(const std::vector<Eigen::Vector3d>& moved, const std::vector<Eigen::Vector3d>& fine) const;

private:
  Fibres Coarse;
  std::vector<std::size_t> Kept; ///< the fine control point of each coarse one
};

} // namespace cactus
