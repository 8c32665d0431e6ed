// SPDX-License-Identifier: BSD-3-Clause
// Findings of a run for the next one, which may have lost some.
#pragma once

#include "base/Recollection.h"

#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace cactus_testing
{

class FindingsInMemory : public cactus::FindingsStore
{
public:
  std::optional<std::string> take(const std::string& name) override
  {
    const auto found = this->Before.find(name);
    if (found == this->Before.end())
    {
      return std::nullopt;
    }
    const std::string bytes = found->second;
    this->Before.erase(found);
    return bytes;
  }
  void keep(const std::string& name, const std::string& bytes) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->kept[name] = bytes;
  }

  /// Begins another run, which finds the kept findings for which `stays(name)` holds.
  void beginAgain(const std::function<bool(const std::string& name)>& stays = [](const std::string&) { return true; })
  {
    this->Before.clear();
    for (const auto& entry : this->kept)
    {
      if (stays(entry.first))
      {
        this->Before.insert(entry);
      }
    }
    this->kept.clear();
  }

  std::map<std::string, std::string> kept;

private:
  std::map<std::string, std::string> Before;
  std::mutex Mutex;
};

} // namespace cactus_testing
