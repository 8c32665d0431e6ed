// SPDX-License-Identifier: BSD-3-Clause
#include "growth/TileStore.h"

#include <algorithm>
#include <utility>

namespace cactus
{

namespace
{

/// Number of tiles that are allocated together.
constexpr std::size_t fewestTogether = 16;
constexpr std::size_t mostTogether = 2048;

bool isPrime(std::size_t number)
{
  for (std::size_t divisor = 2; divisor * divisor <= number; ++divisor)
  {
    if (number % divisor == 0)
    {
      return false;
    }
  }
  return true;
}

/// Returns a prime, so that tiles behind one another along an axis do not fall into few sets.
std::size_t setsFor(std::size_t most, std::size_t ways)
{
  std::size_t sets = std::max<std::size_t>(1, most / ways);
  while (!isPrime(sets))
  {
    --sets;
  }
  return sets;
}

} // namespace

TileStore::TileStore(std::size_t most)
  : Ways(std::min(ways, most))
  , Sets(setsFor(most, this->Ways))
  , Space(std::make_shared<Rooms>())
{
}

TileStore::~TileStore()
{
  const std::lock_guard<std::mutex> lock(this->Space->mutex);
  this->Space->isUsed = false; // tiles may still be held
  this->Space->idle.clear();
}

TileStore::Room TileStore::Rooms::take()
{
  const std::lock_guard<std::mutex> lock(this->mutex);
  if (this->idle.empty())
  {
    // Doubles the number of tiles.
    const std::size_t more = std::clamp(this->count, fewestTogether, mostTogether);
    const std::shared_ptr<Tile[]> slab(new Tile[more]);
    this->count += more;
    this->idle.reserve(this->count); // so that returning a tile needs no memory
    for (std::size_t i = more; i-- > 0;)
    {
      this->idle.push_back({ slab.get() + i, slab });
    }
  }
  Room room = std::move(this->idle.back());
  this->idle.pop_back();
  return room;
}

std::shared_ptr<Tile> TileStore::make()
{
  const Room room = this->Space->take();
  const auto giveBack = [rooms = this->Space, slab = room.slab](Tile* tile)
  {
    const std::lock_guard<std::mutex> lock(rooms->mutex);
    if (rooms->isUsed)
    {
      rooms->idle.push_back({ tile, slab });
    }
  };
  return { room.tile, giveBack };
}

std::shared_ptr<const Tile> TileStore::find(std::uint64_t number)
{
  const std::size_t place = number % this->Sets.size();
  Set& set = this->Sets[place];
  const std::lock_guard<std::mutex> lock(this->Locks[place % locks]);
  for (std::size_t way = 0; way < this->Ways; ++way)
  {
    if (set.numbers[way] == number && set.uses[way] != 0)
    {
      set.uses[way] = ++set.use;
      return set.tiles[way];
    }
  }
  return nullptr;
}

void TileStore::keep(std::uint64_t number, std::shared_ptr<const Tile> tile)
{
  const std::size_t place = number % this->Sets.size();
  Set& set = this->Sets[place];
  {
    const std::lock_guard<std::mutex> lock(this->Locks[place % locks]);
    std::size_t oldest = 0;
    for (std::size_t way = 0; way < this->Ways; ++way)
    {
      if (set.numbers[way] == number && set.uses[way] != 0)
      {
        return;
      }
      oldest = set.uses[way] < set.uses[oldest] ? way : oldest;
    }
    set.numbers[oldest] = number;
    set.uses[oldest] = ++set.use;
    set.tiles[oldest].swap(tile);
  }
  // The evicted tile is released here, after the lock.
}

std::size_t TileStore::rooms() const
{
  const std::lock_guard<std::mutex> lock(this->Space->mutex);
  return this->Space->count;
}

} // namespace cactus
