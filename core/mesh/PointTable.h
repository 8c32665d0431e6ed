// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace cactus
{

/// Numbers of points by keys, all in one place in memory: a table of the standard library allocates for each.
class PointTable
{
public:
  static constexpr std::int32_t none = -1;

  /// The number at a key, `none` where it is new; good until the next call. Any key but the largest one.
  std::int32_t& operator[](std::uint64_t key)
  {
    if (2 * this->Count >= this->Entries.size())
    {
      this->grow();
    }
    Entry& entry = this->entryOf(key);
    if (entry.key != key)
    {
      entry.key = key;
      ++this->Count;
    }
    return entry.number;
  }

  /// Forgets all, and keeps the room.
  void clear()
  {
    if (this->Count > 0)
    {
      this->Entries.assign(this->Entries.size(), Entry());
      this->Count = 0;
    }
  }

private:
  struct Entry
  {
    std::uint64_t key = std::numeric_limits<std::uint64_t>::max(); ///< of none
    std::int32_t number = none;
  };

  /// That of a key, or the one where it is to be.
  Entry& entryOf(std::uint64_t key)
  {
    const std::size_t last = this->Entries.size() - 1; // a power of two
    // The upper bits of a product with a large odd number are well mixed.
    std::size_t at = ((key * 0x9e3779b97f4a7c15U) >> 32) & last;
    while (this->Entries[at].key != key && this->Entries[at].key != Entry().key)
    {
      at = (at + 1) & last;
    }
    return this->Entries[at];
  }

  void grow()
  {
    constexpr std::size_t fewest = 256;
    std::vector<Entry> before(this->Entries.empty() ? fewest : 2 * this->Entries.size());
    before.swap(this->Entries);
    for (const Entry& entry : before)
    {
      if (entry.key != Entry().key)
      {
        this->entryOf(entry.key) = entry;
      }
    }
  }

  std::vector<Entry> Entries; ///< at most half of them are used
  std::size_t Count = 0;
};

} // namespace cactus
