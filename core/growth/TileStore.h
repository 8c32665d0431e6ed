// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "growth/LabelImage.h"
#include "growth/LabelSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace cactus
{

/// The samples of a label image in one of its tiles, x fastest; `grid` gives their number.
struct Tile
{
  static constexpr std::size_t size =
    std::size_t(LabelSource::tileEdge) * std::size_t(LabelSource::tileEdge) * std::size_t(LabelSource::tileEdge);

  VoxelGrid grid; ///< within the image
  std::array<std::int32_t, size> fibreId;
  std::array<float, size> depth;
};

/// A cache of the most recently used tiles, limited in number. Thread-safe.
///
/// It is set-associative: each tile has a place in one of many small sets, by its number, and the least recently used tile of the
/// set is evicted. So a look-up touches little memory, which matters for millions of them. Consecutive numbers are spread evenly
/// over the sets. Memory of tiles that nobody holds is reused; it is freed with the store, except the slabs (64 MB at most) of
/// tiles that are still held.
class TileStore
{
public:
  /// Keeps at most this many tiles, 1 or more.
  explicit TileStore(std::size_t most);
  ~TileStore();
  TileStore(const TileStore&) = delete;
  TileStore& operator=(const TileStore&) = delete;

  /// Returns a tile to be filled; its numbers are undefined.
  std::shared_ptr<Tile> make();
  /// Returns null if that tile was never kept or was evicted.
  std::shared_ptr<const Tile> find(std::uint64_t number);
  /// Keeps the tile, unless another thread has already kept it.
  void keep(std::uint64_t number, std::shared_ptr<const Tile> tile);

  /// Returns for how many tiles memory is allocated.
  std::size_t rooms() const;

private:
  static constexpr std::size_t ways = 16;
  static constexpr std::size_t locks = 256;

  struct Set
  {
    std::array<std::uint64_t, ways> numbers{};
    std::array<std::uint64_t, ways> uses{}; ///< last use of each tile, 0 for an empty place
    std::uint64_t use = 0;                  ///< counter of uses
    std::array<std::shared_ptr<const Tile>, ways> tiles;
  };
  /// Memory of a tile, in a slab of many: separate tiles would fragment the heap.
  struct Room
  {
    Tile* tile;
    std::shared_ptr<Tile[]> slab;
  };
  struct Rooms
  {
    std::mutex mutex;
    std::vector<Room> idle;
    std::size_t count = 0;
    bool isUsed = true; ///< false once the store is gone: returned memory is freed

    Room take();
  };

  std::size_t Ways; ///< ways of each set that are in use
  std::vector<Set> Sets;
  std::array<std::mutex, locks> Locks; ///< each guards the sets whose number has that remainder
  std::shared_ptr<Rooms> Space;
};

} // namespace cactus
