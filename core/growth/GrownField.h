// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "growth/CapsuleField.h"
#include "growth/FibreRadialGrowthOptions.h"
#include "growth/FieldCell.h"
#include "growth/FieldRelevance.h"
#include "growth/LabelImage.h"
#include "growth/LabelSource.h"
#include "growth/RankedGrowth.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cactus
{

/// The field that growFibres() computes from the seed fields, for parts of the image.
class GrownField
{
public:
  /// Prepares the field. `part` is a part of growthGrid(), the fibres are valid and the growth is finite. Throws OutOfMemory.
  GrownField(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part, int threads);

  /// The part.
  const VoxelGrid& grid() const { return this->Part; }
  const CapsuleField& seeds() const { return this->Seeds; }
  const FieldRelevance& relevance() const { return this->Relevance; }

  /// Returns the outline of a fibre by rank, see CapsuleField.
  FibreOutline outline(int rank) const;
  /// Returns -1 if no fibre has that id.
  int rankOf(std::int32_t fibreId) const;
  /// Returns all blocks with samples of a fibre, and possibly others near it (see CapsuleField::blocksNear()).
  std::vector<std::array<int, 3>> blocksOf(int rank) const;

  /// Writes FibreId and Depth of a cell's samples to their places in `held`, which contains all of them.
  void enter(const FieldCell& cell, const VoxelGrid& held, std::int32_t* fibreId, float* depth) const;

private:
  VoxelGrid Part;
  double HalfGap;
  double Band; ///< µm outside a fibre, beyond which depths are only bounded
  FieldRelevance Relevance;
  CapsuleField Seeds;
  RankedGrowth Growth;                ///< µm
  std::vector<std::int32_t> IdOfRank; ///< increasing
  std::vector<double> RadiusOfRank;   ///< target, µm
};

} // namespace cactus
