// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// Both ends of a capsule with their radii in one cache line, the unit that a loop over pairs reads.
struct alignas(64) Capsule
{
  double p0[3];
  double r0;
  double p1[3];
  double r1;
};

/// All capsules of all fibres, in fibre order. Capsule k spans the control points first[k] and first[k] + 1.
struct Capsules
{
  std::vector<Capsule> bodies;
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> fibre;    ///< index of the fibre in its Fibres, not FibreId
  std::vector<Eigen::Vector3d> places; ///< per fibre, a random point by FibreId that breaks ties between fibres in the same place

  std::size_t size() const { return bodies.size(); }
};

/// Consecutive capsules: begin … end − 1.
struct CapsuleRange
{
  std::size_t begin = 0;
  std::size_t end = 0;

  std::size_t size() const { return end - begin; }
};

Capsules capsulesOf(const Fibres& fibres);

/// Returns the places of fibres (see Capsules) by FibreId.
std::vector<Eigen::Vector3d> placesOf(const std::vector<int>& fibreIds);

} // namespace cactus
