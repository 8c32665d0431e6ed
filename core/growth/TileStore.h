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

/// The samples of a label image in one of its tiles, x fastest, as many as `grid` says.
struct Tile
{
  static constexpr std::size_t size =
    std::size_t(LabelSource::tileEdge) * std::size_t(LabelSource::tileEdge) * std::size_t(LabelSource::tileEdge);

  VoxelGrid grid; ///< within the image
  std::array<std::int32_t, size> fibreId;
  std::array<float, size> depth;
};

/// Keeps the tiles that were used last, up to a certain number. May be used from several threads.
///
/// Each tile has its place in one of many small sets, by its number, and the one that goes is that of the set which was used
/// longest ago. So a look at one touches little memory; what is asked for millions of times would wait for more. Tiles of
/// numbers that follow one another are spread evenly. Room of tiles that nobody has any longer is used again; it is given back
/// with the store, but for the slabs (64 MB at most) of tiles that somebody still has.
class TileStore
{
public:
  /// At most so many are kept, 1 or more.
  explicit TileStore(std::size_t most);
  ~TileStore();
  TileStore(const TileStore&) = delete;
  TileStore& operator=(const TileStore&) = delete;

  /// One to be filled, whose numbers are not defined yet.
  std::shared_ptr<Tile> make();
  /// Null where that tile is not kept, or no longer.
  std::shared_ptr<const Tile> find(std::uint64_t number);
  /// Where another thread was faster, its tile stays.
  void keep(std::uint64_t number, std::shared_ptr<const Tile> tile);

  /// For how many tiles there is room by now.
  std::size_t rooms() const;

private:
  static constexpr std::size_t ways = 16;
  static constexpr std::size_t locks = 256;

  struct Set
  {
    std::array<std::uint64_t, ways> numbers{};
    std::array<std::uint64_t, ways> uses{}; ///< of each tile the last one, 0 for an empty place
    std::uint64_t use = 0;                  ///< counts them
    std::array<std::shared_ptr<const Tile>, ways> tiles;
  };
  /// For a tile, in a slab of many: among all that comes and goes, tiles would leave no large room free.
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
    bool isUsed = true; ///< else what is given back is of no use any longer

    Room take();
  };

  std::size_t Ways; ///< of each set that are in use
  std::vector<Set> Sets;
  std::array<std::mutex, locks> Locks; ///< each of the sets whose number leaves that rest
  std::shared_ptr<Rooms> Space;
};

} // namespace cactus
