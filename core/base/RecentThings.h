// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace cactus
{

/// A least-recently-used cache, limited to a number of entries or, if they have weights, to a total weight. Several threads may
/// use it.
template <typename Thing>
class RecentThings
{
public:
  explicit RecentThings(std::size_t most)
    : Most(most)
  {
  }

  /// Returns null if the entry was never kept or was evicted.
  std::shared_ptr<const Thing> find(std::uint64_t key)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = this->Places.find(key);
    if (found == this->Places.end())
    {
      return nullptr;
    }
    this->Things.splice(this->Things.begin(), this->Things, found->second);
    return found->second->thing;
  }

  /// Keeps `thing`, unless another thread has already kept one under this key.
  void keep(std::uint64_t key, std::shared_ptr<const Thing> thing, std::size_t weight = 1)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Places.count(key) > 0)
    {
      return;
    }
    this->Things.push_front({ key, std::move(thing), weight });
    this->Places[key] = this->Things.begin();
    this->Weight += weight;
    while (this->Weight > this->Most && this->Things.size() > 1)
    {
      this->Weight -= this->Things.back().weight;
      this->Places.erase(this->Things.back().key);
      this->Things.pop_back();
    }
  }

private:
  struct Entry
  {
    std::uint64_t key;
    std::shared_ptr<const Thing> thing;
    std::size_t weight;
  };

  std::size_t Most;
  std::size_t Weight = 0;
  std::mutex Mutex;
  std::list<Entry> Things; ///< most recently used first
  std::unordered_map<std::uint64_t, typename std::list<Entry>::iterator> Places;
};

} // namespace cactus
