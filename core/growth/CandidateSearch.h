// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "growth/CapsuleSeeds.h"
#include "growth/FieldKernels.h"
#include "growth/FieldRelevance.h"
#include "growth/SeedBins.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// The cones that can matter in one block of samples, in single precision relative to an origin near them, grouped by fibre.
class Candidates
{
public:
  void clear();
  /// Starts the group of one fibre; its cones follow.
  void beginGroup(int rank);
  void add(const Cone& cone, const Eigen::Vector3d& origin);
  /// Makes the columns readable in whole vectors.
  void finish();
  /// Allocates memory for a part of `others`, in place of the present content.
  void makeRoomFor(const Candidates& others);

  /// Returns columns for kernels, valid until the candidates change.
  ConeGroups all();

private:
  std::vector<ConeGroup> Groups;
  std::vector<float> Columns[ConeColumns::Numbers];
  std::size_t Count = 0;
};

/// Finds the candidates of blocks; each thread has its own.
class CandidateSearch
{
public:
  CandidateSearch(const CapsuleSeeds& seeds, const SeedBins& bins);

  /// Returns the approximate number of pieces that a search within `extent` of a place looks at.
  double piecesWithin(double extent) const;

  /// Returns all cones that can matter within `extent` of `centre`, relative to `origin`, valid until the next call.
  Candidates& find(const Eigen::Vector3d& centre, double extent, const FieldRelevance& relevance, const Eigen::Vector3d& origin);

private:
  struct Found
  {
    int rank;
    std::uint32_t piece;
    double value; ///< at the centre
  };
  /// The last visits to a piece.
  struct Seen
  {
    std::uint32_t collection = 0; ///< last collection that met it
    std::uint32_t search = 0;     ///< last search that evaluated it
    double value = 0.0;           ///< value at the centre in that search
  };

  void collect(const Eigen::Vector3d& centre, double reach);
  void rankFields();
  double neededReach(double extent, const FieldRelevance& relevance) const;
  void keep(double extent, const Eigen::Vector3d& origin);

  const CapsuleSeeds& Seeds;
  const SeedBins& Bins;
  std::vector<Seen> SeenPieces; ///< per piece
  std::uint32_t Collection = 0;
  std::uint32_t Search = 0;
  std::vector<Found> Pieces;  ///< those with a field above the reach at the centre
  std::vector<double> Fields; ///< per rank: the largest field at the centre
  std::vector<int> Ranks;     ///< ranks of the fibres found
  double Best = 0.0;          ///< largest field at the centre, of the fibres found
  double Second = 0.0;        ///< second largest
  Candidates Kept;
};

} // namespace cactus
