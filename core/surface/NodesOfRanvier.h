// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/MyelinSurfaceOptions.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// The nodes of Ranvier of one fibre, as places along its centre line: at equal distances, from a random first one on.
class NodesOfRanvier
{
public:
  /// The fibre's outer diameter (µm) determines its internodes. A line that repeats after `period` µm (0: it does not) has a
  /// whole number of nodes in a period, on average as many as other lines.
  NodesOfRanvier(const MyelinSurfaceOptions& options, std::int32_t fibreId, double diameter, double period);

  /// Returns the distance (µm) from the middle of a node to that of the next; 0 if there is none.
  double spacing() const { return this->Spacing; }
  /// Returns the part of the internodes' myelin that there is at a place (µm along the line): 0 in a node, 1 in an internode,
  /// and in between in a paranode, with no slope at both of its ends.
  double myelinPart(double along) const;
  /// Returns the middles of the nodes from one place to another, increasing.
  std::vector<double> between(double from, double to) const;
  /// Tells whether a node or a paranode lies from one place to another.
  bool reachInto(double from, double to) const;

private:
  double HalfNode; ///< µm
  double Paranode; ///< µm
  double Spacing = 0.0;
  double First = 0.0; ///< µm, place of a node
};

} // namespace cactus
