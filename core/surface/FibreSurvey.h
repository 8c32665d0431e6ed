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
#include <tuple>
#include <vector>

namespace cactus
{

/// The box of a fibre's samples in one piece of a label image (see ImagePieces).
struct FoundBox
{
  std::uint32_t piece = 0;                ///< see ImagePieces
  std::array<std::uint8_t, 3> ends{ {} }; ///< per axis: the first sample in the piece, plus 16 times the last one
};

inline auto membersOf(FoundBox& box)
{
  return std::tie(box.piece, box.ends);
}

/// The samples of a fibre found in one pass over a label image.
struct FoundFibre
{
  double depths = 0.0;         ///< µm, sum over its samples
  double samples = 0.0;        ///< number of samples
  std::vector<FoundBox> boxes; ///< by piece, increasing
};

inline auto membersOf(FoundFibre& fibre)
{
  return std::tie(fibre.depths, fibre.samples, fibre.boxes);
}

/// Share of the total progress spent in the survey.
constexpr double shareOfLooking = 0.01;

/// Fibres found, keyed by FibreId.
using FoundFibres = std::map<std::int32_t, FoundFibre>;

/// Finds the fibres of a field. Each sample is read once, in pieces that a source computes at once; their results are merged in
/// their order, so that the result does not depend on threads or processes, which share the work and all get the whole result.
/// Throws InvalidInput for a negative FibreId, a Depth that is not finite, is beyond limits::coordinate or does not fit its
/// FibreId, and Cancelled.
FoundFibres findFibres(const FibreField& field, const Context& context = {}, const Sharing& sharing = Sharing());

/// Does the same for some fibres.
FoundFibres findFibres(
  const FibreField& field, const std::set<std::int32_t>& fibres, const Context& context, const Sharing& sharing);

/// Does the same for some fibres in given pieces, increasing, which include all that hold samples of them.
FoundFibres findFibres(const FibreField& field, const std::set<std::int32_t>& fibres, const std::vector<std::uint32_t>& pieces,
  const Context& context = {}, const Sharing& sharing = Sharing());

/// Does the same for one fibre, in an image that is known to be valid.
FoundFibre findFibre(const FibreField& field, std::int32_t fibre, const std::vector<std::uint32_t>& pieces);

/// Returns the nodes of a box.
NodeRange nodesOf(const FibreField& field, const FoundBox& box);

/// Returns the numbers of the pieces with the samples that give some nodes their values.
std::vector<std::uint32_t> piecesAt(const FibreField& field, const NodeRange& nodes);

} // namespace cactus
