// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace cactus
{

/// A first simulation with the MC/DC simulator (Rafael-Patino et al. 2020), for the user to edit. SI units, as in its files.
struct McdcOptions
{
  int walkers = 1000;
  int steps = 5000;
  double diffusivity = 2e-9;                    ///< m²/s
  double gradientDuration = 0.010;              ///< s, δ
  double gradientSeparation = 0.020;            ///< s, Δ
  double echoTime = 0.035;                      ///< s, also the simulated time; more than Δ + δ
  std::vector<double> bValues{ 1e9, 2e9, 3e9 }; ///< s/m²
  double permeability = 0.0;                    ///< probability of crossing a surface at a hit
  int directions = 30;                          ///< per b-value, spread over the half sphere

  /// Returns the root mean square displacement (µm) of a free walker along one axis within the echo time.
  double displacement() const;
};

/// Returns the configuration of one simulation, with paths relative to the working directory. Walkers start inside the domain
/// (µm), away from its boundary by their free displacement or, if that is less, a quarter of the side; the voxel leaves so much
/// room around the domain that no walker reaches its periodic walls, which would map it into another fibre. Keys are spelt
/// exactly as in the simulator, because it confuses similar ones.
std::string mcdcConfiguration(const McdcOptions& options, const Domain& domain, const std::string& plyList,
  const std::string& scheme, const std::string& outputPrefix, const std::string& compartment);

/// Returns the acquisition (PGSE, format VERSION: STEJSKALTANNER): one line without gradient, then every b-value along every
/// direction.
std::string mcdcScheme(const McdcOptions& options);

/// Returns unit vectors: a golden-angle spiral from the pole to the equator; the first one is close to the bundles' usual axis,
/// z.
std::vector<Eigen::Vector3d> mcdcDirections(int count);

/// Returns the list of obstacles: the scale from µm to the simulator's mm, then one path per line; for permeable ones, one line
/// each of path, scale and permeability.
std::string mcdcPlyList(const std::vector<std::string>& paths, double permeability = 0.0);

} // namespace cactus
