// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace cactus
{

/// A hash table of point numbers in one block of memory: tables of the standard library allocate for each entry.
class PointTable
{
public:
  static constexpr std::int32_t none = -1;

  /// Returns the number of a key, `none` if it is new; valid until the next call. Any key but the largest one is allowed.
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

  /// Removes all entries, and keeps the memory.
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
    std::uint64_t key = std::numeric_limits<std::uint64_t>::max(); ///< the largest key marks an empty entry
    std::int32_t number = none;
  };

  /// Returns the entry of a key, or the one where it belongs.
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
