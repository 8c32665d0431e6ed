// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "mesh/NodeLattice.h"
#include "surface/FibreField.h"
#include "surface/ImagePieces.h"

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace cactus
{

/// The box of a fibre's samples in one piece of a label image (see ImagePieces).
struct FoundBox
{
  std::uint32_t piece = 0;                ///< see ImagePieces
  std::array<std::uint8_t, 3> ends{ {} }; ///< along each axis: the first sample in the piece, and 16 times the last one
};

/// What one look at a label image tells of a fibre.
struct FoundFibre
{
  double depths = 0.0;         ///< µm, sum over its samples
  double samples = 0.0;        ///< how many they are
  std::vector<FoundBox> boxes; ///< by piece, increasing
};

/// Of the progress of making surfaces, what looking for fibres takes.
constexpr double shareOfLooking = 0.01;

/// By FibreId.
using FoundFibres = std::map<std::int32_t, FoundFibre>;

/// The fibres of a field. Each sample is looked at once, in pieces that a source of samples makes at once; what they hold is put
/// together in their order, so that the result does not depend on threads or processes, which share the work and get all of it.
/// Throws InvalidInput for a negative FibreId, a Depth that is not finite, beyond limits::coordinate or does not fit its FibreId,
/// and Cancelled.
FoundFibres findFibres(const FibreField& field, const Context& context = {}, const Sharing& sharing = Sharing());

/// The same of some fibres.
FoundFibres findFibres(
  const FibreField& field, const std::set<std::int32_t>& fibres, const Context& context, const Sharing& sharing);

/// The same of some fibres, in pieces, increasing, among which are all that hold samples of them.
FoundFibres findFibres(const FibreField& field, const std::set<std::int32_t>& fibres, const std::vector<std::uint32_t>& pieces,
  const Context& context = {}, const Sharing& sharing = Sharing());

/// Of one fibre, and for an image that is known to be a proper one.
FoundFibre findFibre(const FibreField& field, std::int32_t fibre, const std::vector<std::uint32_t>& pieces);

/// Fibres found as bytes, and back.
std::string bytesOf(const FoundFibres& fibres);
FoundFibres foundFrom(const std::string& bytes);

/// The nodes of a box.
NodeRange nodesOf(const FibreField& field, const FoundBox& box);

/// The numbers of the pieces with the samples that some nodes take their values from.
std::vector<std::uint32_t> piecesAt(const FibreField& field, const NodeRange& nodes);

} // namespace cactus
