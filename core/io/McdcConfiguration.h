// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace cactus
{

/// What both first simulations with the MC/DC simulator (Rafael-Patino et al. 2020) share, to be edited by whoever runs them. SI
/// units, as in its files.
struct McdcOptions
{
  int walkers = 1000;
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

/// One of the simulations: inside the axons, or outside the fibres.
struct McdcSimulation
{
  std::string compartment; ///< "intra" or "extra"
  double longestStep;      ///< µm
  Domain start;            ///< the box where walkers start
  int startPositions = 0;  ///< lines of start/COMPARTMENT.txt, for a walker each; 0: the simulator draws its own
};

/// Walkers inside axons: each step is as long as the smallest radius (µm) at most, but no shorter than those outside, and 0.3 µm
/// at most. The box to start in is off the domain's faces by the free displacement or, if that is less, by a quarter of the side:
/// axons end there in caps, which reflect. Where axons go on through periodic faces (`goOn`), walkers start up to these.
McdcSimulation intraSimulation(const McdcOptions& options, const Domain& domain, bool goOn, double smallestRadius);

/// Walkers outside fibres: each step is 0.05 µm at most. The box to start in is off the domain's faces by four times the free
/// displacement or, if that is less, by three eighths of the side: walkers that come to a face leave the substrate.
McdcSimulation extraSimulation(const McdcOptions& options, const Domain& domain);

/// The fewest steps, of two digits, that are shorter than `longestStep` (µm): each is √(6 D t / T) long.
int mcdcSteps(const McdcOptions& options, double longestStep);

/// The configuration of one simulation, with paths relative to the folder it is started in: mcdc/COMPARTMENT_ply_list.txt,
/// mcdc/pgse.scheme, mcdc/output/COMPARTMENT and start/COMPARTMENT.txt. The voxel leaves walkers so much room around the domain
/// that none reaches its periodic walls, which would map it into another fibre. Keys are written exactly as the simulator spells
/// them, because it takes similar ones for each other.
std::string mcdcConfiguration(const McdcOptions& options, const Domain& domain, const McdcSimulation& simulation);

/// Returns the acquisition (PGSE, format VERSION: STEJSKALTANNER): one line without gradient, then every b-value along every
/// direction.
std::string mcdcScheme(const McdcOptions& options);

/// Returns unit vectors: a golden-angle spiral from the pole to the equator; the first one is close to the bundles' usual axis,
/// z.
std::vector<Eigen::Vector3d> mcdcDirections(int count);

/// The list of obstacles: the scale from µm to the simulator's mm, then one path per line; for permeable ones, one line each of
/// path, scale and permeability, which is what rules as long as the configuration has none for all.
std::string mcdcPlyList(const std::vector<std::string>& paths, double permeability = 0.0);

} // namespace cactus
