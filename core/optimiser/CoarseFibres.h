// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// Fibres with about every second of their control points, and the interpolation of the others. It treats each fibre
/// independently of the others.
class CoarseFibres
{
public:
  /// Drops a control point if the one before it is kept and the fibre runs nearly straight from that to the next. Ends are kept,
  /// and no segment gets zero length that had none before.
  explicit CoarseFibres(const Fibres& fine);

  const Fibres& fibres() const { return this->Coarse; }

  /// Interpolates values to all control points of the fine fibres from those at the coarse ones, which are kept: a cubic between
  /// each two, continuous in its first derivative (Catmull and Rom 1974). Exact if values grow evenly from each control point to
  /// the next.
  std::vector<Eigen::Vector3d> interpolate(const std::vector<Eigen::Vector3d>& values) const;

  /// Returns the fine fibres' control points after the coarse ones have moved to `moved`: `fine`, the previous positions,
  /// displaced like their neighbours along the fibre.
  std::vector<Eigen::Vector3d> refine(const std::vector<Eigen::Vector3d>& moved, const std::vector<Eigen::Vector3d>& fine) const;

private:
  Fibres Coarse;
  std::vector<std::size_t> Kept; ///< per coarse control point, its index in the fine fibres
};

} // namespace cactus
