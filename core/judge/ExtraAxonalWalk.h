// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Constants.h"
#include "base/Context.h"
#include "base/Domain.h"
#include "base/Properties.h"
#include "mesh/FibreSurfaces.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Options of a random walk outside the fibres.
struct ExtraAxonalWalkOptions
{
  int walkers = 0; ///< 0: none
  /// Root mean square displacement (µm) of a free walker along each axis at the end.
  double distance = 5.0;
  double step = 0.1; ///< µm, between two changes of direction
  std::uint64_t seed = 1;

  static const PropertyList<ExtraAxonalWalkOptions>& properties();
};

/// The long-time diffusivity outside the fibres relative to free diffusion; NaN without walkers.
struct ExtraAxonalDiffusion
{
  Eigen::Vector3d ratio = Eigen::Vector3d::Constant(notANumber);         ///< D∞/D₀ along x, y and z
  Eigen::Vector3d standardError = Eigen::Vector3d::Constant(notANumber); ///< of each
  std::size_t leaked = 0; ///< walkers that came to be inside a fibre or without any room; they do not count
};

/// Simulates a random walk outside the surfaces: steps of one length in random directions, which walls and the domain's faces
/// reflect. A face mirrors the substrate, so that walkers continue in its mirror image: the space is unbounded, and displacements
/// are measured in it. Periodic faces let them in on the other side, and displacements go on.
///
/// The ratio is the growth of the mean squared displacement over the second half of the walk, relative to that of free walkers:
/// the early part, before the walkers have seen the fibres around them, drops out (D(t) − D∞ falls off as ln t / t, Burcaw et al.
/// 2015, NeuroImage 114:18). A step may be longer than the width of a gap: between parallel walls it moves a walker along them as
/// without them. The result does not depend on threads.
///
/// Surfaces have to be closed, apart from each other, and in the domain. Throws Infeasible if hardly any of the domain is
/// outside, or if more than one in a hundred walkers leaks; InvalidInput for options out of range; Cancelled.
ExtraAxonalDiffusion walkOutside(
  const Domain& domain, const FibreSurfaces& outer, const ExtraAxonalWalkOptions& options, const Context& context = {});

/// Walkers outside the fibres that come to a face of the domain.
struct LeavingWalkers
{
  std::size_t walkers = 0; ///< that walked to the end: none that leaked or found no room to start
  std::size_t leaving = 0; ///< of these
  /// For each of `early` walkers that leaves before `until`, what free walkers have moved by then along each axis (µm, root mean
  /// square: the square is 2 D t); increasing.
  std::vector<double> distances;
  std::size_t early = 0; ///< walkers that walked as far as `until`, or to the end
  double until = 0.0;    ///< µm

  double share() const { return this->walkers > 0 ? double(this->leaving) / double(this->walkers) : notANumber; }
};

/// Walkers that start evenly in a box of the domain, outside the surfaces, walk until they come to a face of the domain, or until
/// free walkers have moved by `distance` (µm along each axis, root mean square). There are 1,000 of them. Where of the first 200
/// more than 15 % leave, the others walk only until 15 % have left, so that these two are known: how many leave, to a few per
/// cent, and when the first do. Steps are 0.5 µm at most, longer than some pores: what leads out is motion along fibres. The
/// result does not depend on threads. Throws OutOfMemory where the surfaces do not fit into memory, and Cancelled.
LeavingWalkers walkUntilLeaving(const Domain& domain, const Domain& start, const FibreSurfaces& outer, double distance,
  std::uint64_t seed, const Context& context = {});

/// The share of walkers that leave where there are no fibres, exactly: fibres in their way leave more of them inside.
double freeLeavingShare(const Domain& domain, const Domain& start, double distance);

} // namespace cactus
