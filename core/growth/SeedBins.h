// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "growth/CapsuleSeeds.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Uniform bins over the bounding boxes of pieces, which find those near a point.
class SeedBins
{
public:
  /// Bins the pieces. Throws OutOfMemory.
  SeedBins(const std::vector<SeedPiece>& pieces, int threads);

  /// Returns the edge of a bin (µm).
  double size() const { return this->Size; }
  /// Returns the mean number of pieces per µm³; a piece counts once for each of its bins.
  double density() const
  {
    return static_cast<double>(this->Pieces.size()) / (static_cast<double>(this->Offsets.size() - 1) * std::pow(this->Size, 3.0));
  }

  /// Calls visit(piece) for the indices of all pieces whose bounding boxes overlap the box, and for others; for some of them
  /// several times.
  template <typename Visit>
  void forEachNear(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, Visit&& visit) const
  {
    this->forEachBin(lower, upper,
      [&](std::size_t bin)
      {
        for (std::uint32_t n = this->Offsets[bin]; n < this->Offsets[bin + 1]; ++n)
        {
          visit(this->Pieces[n]);
        }
      });
  }

private:
  /// Calls visit(bin) for all bins that the box touches.
  template <typename Visit>
  void forEachBin(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, Visit&& visit) const
  {
    const Eigen::Array3i first = this->binOf(lower);
    const Eigen::Array3i last = this->binOf(upper);
    for (int k = first[2]; k <= last[2]; ++k)
    {
      for (int j = first[1]; j <= last[1]; ++j)
      {
        for (int i = first[0]; i <= last[0]; ++i)
        {
          visit(this->index(i, j, k));
        }
      }
    }
  }

  Eigen::Array3i binOf(const Eigen::Vector3d& x) const
  {
    const Eigen::Array3d b = ((x - this->Origin) / this->Size).array().floor();
    return b.max(0.0).min((this->Count - 1).cast<double>()).cast<int>();
  }
  std::size_t index(int i, int j, int k) const
  {
    return std::size_t(i) + std::size_t(this->Count[0]) * (std::size_t(j) + std::size_t(this->Count[1]) * std::size_t(k));
  }
  void choose(const std::vector<SeedPiece>& pieces, int threads);
  void requireRoom(const std::vector<SeedPiece>& pieces, std::size_t bins, std::size_t parts, int threads) const;

  Eigen::Vector3d Origin = Eigen::Vector3d::Zero();
  double Size = 1.0; ///< edge of a bin (µm)
  Eigen::Array3i Count = Eigen::Array3i::Ones();
  std::vector<std::uint32_t> Offsets;
  std::vector<std::uint32_t> Pieces;
};

} // namespace cactus
