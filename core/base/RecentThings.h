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

/// Keeps what was used last, up to a certain number of things. May be used from several threads.
template <typename Thing>
class RecentThings
{
public:
  explicit RecentThings(std::size_t most)
    : Most(most)
  {
  }

  /// Null where it is not kept, or no longer.
  std::shared_ptr<const Thing> find(std::uint64_t key)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = this->Places.find(key);
    if (found == this->Places.end())
    {
      return nullptr;
    }
    this->Things.splice(this->Things.begin(), this->Things, found->second);
    return found->second->second;
  }

  /// Where another thread was faster, its thing stays.
  void keep(std::uint64_t key, std::shared_ptr<const Thing> thing)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Places.count(key) > 0)
    {
      return;
    }
    this->Things.emplace_front(key, std::move(thing));
    this->Places[key] = this->Things.begin();
    if (this->Things.size() > this->Most)
    {
      this->Places.erase(this->Things.back().first);
      this->Things.pop_back();
    }
  }

private:
  using Entry = std::pair<std::uint64_t, std::shared_ptr<const Thing>>;

  std::size_t Most;
  std::mutex Mutex;
  std::list<Entry> Things; ///< the one used last first
  std::unordered_map<std::uint64_t, typename std::list<Entry>::iterator> Places;
};

} // namespace cactus
