// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "growth/Calibre.h"
#include "growth/Cone.h"
#include "growth/SectionShape.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// A piece of a fibre's seed. Pieces are short, so that boxes are tight and single precision suffices near one.
struct SeedPiece
{
  Cone cone;
  int rank; ///< rank of the fibre, see CapsuleSeeds
};

/// The seeds of growth: the fibres' capsules with their calibre, cut into pieces; of a fibre whose sections are not round, three
/// chains of them side by side (see SectionShape); of seeds of points, a thin chain and a piece for each point (see SeedPoints).
/// Fibres are ranked by increasing fibre id.
struct CapsuleSeeds
{
  /// Makes all pieces that come within `reach` of the region; segments farther away are left out. Throws OutOfMemory, and
  /// InvalidInput for a calibre that varies in a domain that is periodic along z.
  CapsuleSeeds(const Fibres& fibres, const SeedOptions& options, const Eigen::AlignedBox3d& region, double reach, int threads);

  std::vector<std::size_t> fibreOfRank;  ///< index into the given fibres
  std::vector<SectionShape> shapes;      ///< by fibre, as given
  std::vector<std::size_t> pieceOffsets; ///< those of rank r are pieces[pieceOffsets[r]] … pieces[pieceOffsets[r + 1] − 1]
  std::vector<std::size_t> chainPieces;  ///< number of those of a rank that lie along the centre line; those of points follow
  std::vector<SeedPiece> pieces;

  /// Returns the number of chains of pieces that a fibre has side by side.
  double chainsOf(std::size_t rank) const;

private:
  void makePieces(const Fibres& fibres, const Calibre& calibre, const SeedOptions& options, const Eigen::AlignedBox3d& region,
    double reach, std::size_t rank);
};

} // namespace cactus
