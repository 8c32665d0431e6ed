// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace cactus
{

/// The contribution of one capsule to the overlap cost: half of the sums over its neighbours (the other half belongs to them) for
/// the cost, and the whole gradient with respect to its own control points and radii.
struct CapsuleOverlap
{
  double gradient0[3];     ///< with respect to p0 (µm³)
  double radius0;          ///< with respect to r0
  double gradient1[3];     ///< with respect to p1
  double radius1;          ///< with respect to r1
  double stiffness0;       ///< diagonal of the Gauss–Newton Hessian for each coordinate of p0 (µm²)
  double stiffness1;       ///< the same for p1
  double cost;             ///< half of the summed pair costs (µm⁴)
  double penetration;      ///< largest D = 1 − d/(rp + rq), without the margin; negative if nothing touches
  std::size_t overlapping; ///< neighbours with D above the tolerance
};

} // namespace cactus
