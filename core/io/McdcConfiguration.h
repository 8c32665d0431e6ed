// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace cactus
{

/// A first simulation with the MC/DC simulator (Rafael-Patino et al. 2020), to be edited by whoever runs it. SI units, as in its
/// files.
struct McdcOptions
{
  int walkers = 1000;
  int steps = 5000;
  double diffusivity = 2e-9;                    ///< m²/s
  double gradientDuration = 0.010;              ///< s, δ
  double gradientSeparation = 0.020;            ///< s, Δ
  double echoTime = 0.035;                      ///< s, also the simulated time; more than Δ + δ
  std::vector<double> bValues{ 1e9, 2e9, 3e9 }; ///< s/m²
  double permeability = 0.0;                    ///< part of the hits on a surface that lead through it
  int directions = 30;                          ///< per b-value, spread over the half sphere

  /// Root mean square displacement (µm) of a free walker along one axis within the echo time.
  double displacement() const;
};

/// The configuration of one simulation, with paths relative to the folder it is started in. Walkers start inside the domain (µm),
/// off its boundary by their free displacement or, if that is less, a quarter of the side; the voxel leaves them so much room
/// around the domain that none reaches its periodic walls, which would map it into another fibre. Keys are written exactly as the
/// simulator spells them, because it takes similar ones for each other.
std::string mcdcConfiguration(const McdcOptions& options, const Domain& domain, const std::string& plyList,
  const std::string& scheme, const std::string& outputPrefix, const std::string& compartment);

/// The acquisition (PGSE, format VERSION: STEJSKALTANNER): one line without gradient, then every b-value along every direction.
std::string mcdcScheme(const McdcOptions& options);

/// Unit vectors: a golden-angle spiral from the pole to the equator, of which the first runs close to the bundles' usual axis, z.
std::vector<Eigen::Vector3d> mcdcDirections(int count);

/// The list of obstacles: the scale from µm to the simulator's mm, then one path per line; for permeable ones, one line each of
/// path, scale and permeability.
std::string mcdcPlyList(const std::vector<std::string>& paths, double permeability = 0.0);

} // namespace cactus
