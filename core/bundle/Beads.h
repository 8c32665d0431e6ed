// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"
#include "base/Random.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cactus
{

/// The shape of an axon with beads: its radius is proportional to 1 + a b(s), where b is a sum of Gaussians of height 1, one for
/// each bead.
struct BeadShape
{
  double spacing = 5.1;          ///< µm, mean distance of neighbouring beads
  double spacingDeviation = 2.3; ///< µm, of these distances, which are gamma distributed; 0: all the same
  double length = 2.0;           ///< µm, over which a bead is higher than half of its height

  static const PropertyList<BeadShape>& properties();
  /// Returns the mean of b along a fibre.
  double mean() const;
  /// Returns the mean of b², from a long fibre.
  double meanSquare() const;
  /// Returns the mean distance (µm) from which on beads of this amplitude (see heightOf()) do not run into each other.
  double leastSpacing(double amplitude) const;
  /// Throws InvalidInput if beads whose radius is larger by `amplitude` than the mean, as a fraction, would run into each other.
  /// `name` begins the names of the properties: <name>Amplitude, <name>Spacing, <name>Length.
  void requireRoom(double amplitude, const std::string& name) const;
  /// Returns the a for which a bead far from others is thicker than the mean radius by this fraction of it. Precondition:
  /// requireRoom().
  double heightOf(double amplitude) const { return amplitude / (1.0 - this->mean() * (1.0 + amplitude)); }
};

/// The beads of one fibre. They depend on seed, fibre id and the number of a bead counted from the fibre's middle, so that a
/// longer fibre has the same beads where a shorter one is.
class Beads
{
public:
  /// Draws the beads of a fibre that reaches `half` (µm) to either side of its middle and, if asked, repeats after that.
  Beads(
    const BeadShape& shape, std::uint64_t seed, int fibreId, double half, bool repeats, RandomStage stage = RandomStage::Calibre);

  /// Returns b at a length (µm) from the fibre's middle, within its reach.
  double at(double length) const;

private:
  double Reach;               ///< µm, beyond which a bead is below 1e-7
  double Width;               ///< µm, standard deviation of the Gaussian
  std::vector<double> Places; ///< increasing
};

} // namespace cactus
