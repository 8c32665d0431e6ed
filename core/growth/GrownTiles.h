// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowthOptions.h"
#include "growth/LabelSource.h"
#include "growth/TileStore.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace cactus
{

/// The label image of growFibres(), computed tile by tile on demand, with the same bits. The most recently used tiles are kept.
/// Memory is proportional to the fibres and the kept tiles, not to the image.
class GrownTiles : public LabelSource
{
public:
  /// Takes the arguments of growFibres(); `fibres` need not outlive the object. `kept` tiles are kept (bytesPerTile each, 1 or
  /// more). Threads share the preparation. Throws as growFibres().
  GrownTiles(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, std::size_t kept, int threads = 1);
  ~GrownTiles() override;

  /// Samples along each edge of a tile.
  static constexpr int edge = tileEdge;
  static constexpr std::size_t bytesPerTile = 8 * Tile::size;

  const VoxelGrid& grid() const override;
  double gap() const override;
  LabelImageView samples(const SampleRange& range, LabelBuffer& buffer) const override;
  const KnownFibres* knownFibres() const override;

  /// Returns how many tiles were computed, repetitions included.
  std::size_t computed() const { return this->Computed; }

private:
  class Growing;

  static void copyTile(const Tile& tile, const VoxelGrid& held, LabelBuffer& buffer);
  std::shared_ptr<const Tile> tile(const std::array<int, 3>& at) const;

  std::unique_ptr<Growing> Source;
  mutable std::atomic<std::size_t> Computed{ 0 };
};

} // namespace cactus
