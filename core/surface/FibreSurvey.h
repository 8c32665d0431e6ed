// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "mesh/NodeLattice.h"
#include "surface/FibreField.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace cactus
{

/// The box of a fibre's samples in one piece of a label image.
struct FoundBox
{
  /// Edge of a piece, in samples; pieces begin at its multiples in the image, as tiles do that are made at once.
  static constexpr int pieceEdge = 16;

  std::uint32_t piece = 0;                ///< number, x fastest
  std::array<std::uint8_t, 3> ends{ {} }; ///< along each axis: the first sample in the piece, and 16 times the last one
};

/// What one look at a label image tells of a fibre.
struct FoundFibre
{
  double depths = 0.0;         ///< µm, sum over its samples
  double samples = 0.0;        ///< how many they are
  std::vector<FoundBox> boxes; ///< by piece, increasing
};

/// By FibreId.
using FoundFibres = std::map<std::int32_t, FoundFibre>;

/// The fibres of a field. Each sample is looked at once, in pieces that a source of samples makes at once; what they hold is put
/// together in their order, so that the result does not depend on threads or processes, which share the work and get all of it.
/// Throws InvalidInput for a negative FibreId, a Depth that is not finite, beyond limits::coordinate or does not fit its FibreId,
/// and Cancelled.
FoundFibres findFibres(const FibreField& field, const Context& context = {}, const Sharing& sharing = Sharing());

/// The nodes of a box.
NodeRange nodesOf(const FibreField& field, const FoundBox& box);

/// The numbers of the pieces with the samples that some nodes take their values from.
std::vector<std::uint32_t> piecesAt(const FibreField& field, const NodeRange& nodes);

/// Blocks of a field's lattice, and where in them and around them a fibre is.
struct NearBlocks
{
  /// So far around a block's nodes is looked for the fibre.
  static constexpr int around = 4;

  std::vector<std::uint32_t> numbers; ///< increasing
  std::vector<NodeRange> inside; ///< per block: a box that holds the fibre's samples there; without nodes where there is none
};

/// All blocks that have a node in a fibre's boxes, or at most `reach` away from them.
NearBlocks blocksNear(const FibreField& field, const FoundFibre& fibre, int reach);

} // namespace cactus
