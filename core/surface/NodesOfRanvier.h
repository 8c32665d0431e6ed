// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "surface/MyelinSurfaceOptions.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// What a lesion has left of an internode's myelin.
enum class Internode
{
  Whole,
  Lost,
  Remyelinated ///< it has come back, thinner than it was
};

/// Returns the fraction of each fibre's internodes that have lost their myelin, so that of all together it is the options'.
/// Fibres without myelin have none to lose.
std::vector<double> internodeLosses(const Fibres& fibres, const MyelinSurfaceOptions& options);

/// The nodes of Ranvier of one fibre, as places along its centre line: at equal distances, from a random first one on.
class NodesOfRanvier
{
public:
  /// The fibre's outer diameter (µm) determines its internodes, of which a fraction `loss` has no myelin. A line that repeats
  /// after `period` µm (0: it does not) has a whole number of nodes in a period, on average as many as other lines.
  NodesOfRanvier(const MyelinSurfaceOptions& options, std::int32_t fibreId, double diameter, double loss, double period);

  /// Returns the distance (µm) from the middle of a node to that of the next; 0 if there is none.
  double spacing() const { return this->Spacing; }
  /// Returns the part of the internodes' myelin that there is at a place (µm along the line): 0 in a node, 1 in an internode,
  /// and in between in a paranode, with no slope at both of its ends.
  double myelinPart(double along) const;
  /// Returns what is left of the internode at a place. The same seed gives the same internodes, and a larger fraction more of
  /// them.
  Internode internodeAt(double along) const;
  /// Returns the middles of the nodes from one place to another, increasing.
  std::vector<double> between(double from, double to) const;
  /// Tells whether a node, a paranode or an internode that is not whole lies from one place to another.
  bool reachInto(double from, double to) const;

private:
  double internodeNumber(double along) const;

  std::uint64_t Seed;
  std::uint64_t FibreId;
  double Loss;         ///< fraction of the internodes that have lost their myelin
  double Remyelinated; ///< fraction of these whose myelin has come back
  double HalfNode;     ///< µm
  double Paranode;     ///< µm
  double Spacing = 0.0;
  double First = 0.0;     ///< µm, place of a node
  double PerPeriod = 0.0; ///< number of internodes after which the line repeats; 0 if it does not
};

} // namespace cactus
