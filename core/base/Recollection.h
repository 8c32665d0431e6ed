// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Bytes.h"
#include "base/Sharing.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// Stores the results of sub-tasks as bytes under their names, for a later run of the same work.
class FindingsStore
{
public:
  virtual ~FindingsStore() = default;

  /// Returns, once, the result of an earlier run. Not thread-safe.
  virtual std::optional<std::string> take(const std::string& name) = 0;
  /// Stores a result. Thread-safe. Throws FileError.
  virtual void keep(const std::string& name, const std::string& bytes) = 0;
};

/// A cache of an earlier run's results for a task, so that they need not be computed again. A default-constructed one knows and
/// keeps nothing.
class Recollection
{
public:
  Recollection() = default;
  /// Uses `store`, which must outlive this object and all objects made from it.
  explicit Recollection(FindingsStore& store)
    : Store(&store)
  {
  }

  /// Returns the cache of a sub-task.
  Recollection part(const std::string& name) const
  {
    Recollection part = *this;
    part.Name += (this->Name.empty() ? "" : "/") + name;
    return part;
  }
  std::optional<std::string> recall() const { return this->Store != nullptr ? this->Store->take(this->Name) : std::nullopt; }
  void note(const std::string& bytes) const
  {
    if (this->Store != nullptr)
    {
      this->Store->keep(this->Name, bytes);
    }
  }

  /// Returns the cached result, or else that of compute(), which all processes call together.
  template <typename Compute>
  auto once(const Sharing& sharing, Compute&& compute) const -> decltype(compute())
  {
    if (this->Store == nullptr)
    {
      return compute();
    }
    const std::string known = sharing.fromFirst(this->recall().value_or(std::string()));
    decltype(compute()) result{};
    if (!known.empty())
    {
      getAll(known, result);
      return result;
    }
    result = compute();
    if (sharing.isFirst())
    {
      this->note(bytesOf(result));
    }
    return result;
  }

  /// Calls take(i, bytes) for those of `all` with a cached result, one after the other, and returns the others.
  template <typename Take>
  std::vector<std::size_t> takeKnown(const Sharing& sharing, const std::vector<std::size_t>& all, Take&& take) const
  {
    if (this->Store == nullptr)
    {
      return all;
    }
    std::vector<std::optional<std::string>> known;
    std::vector<std::uint64_t> isKnown;
    for (const std::size_t i : all)
    {
      known.push_back(this->part(std::to_string(i)).recall());
      isKnown.push_back(known.back() ? 1 : 0);
    }
    sharing.addUp(isKnown); // one process may know results that others do not
    std::vector<std::size_t> left;
    for (std::size_t place = 0; place < all.size(); ++place)
    {
      if (isKnown[place] < std::uint64_t(sharing.size()))
      {
        left.push_back(all[place]);
        continue;
      }
      take(all[place], *known[place]);
      known[place].reset();
    }
    return left;
  }

  /// Runs Sharing::loop() over the i without a cached result; calls take(i, bytes) for the others, one after the other.
  template <typename Body, typename BytesOf, typename Take>
  void loop(const Sharing& sharing, std::size_t count, const Context& context, Body&& body, BytesOf&& bytesOf, Take&& take,
    const std::string& message, double from, double to) const
  {
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), std::size_t(0));
    const std::vector<std::size_t> left = this->takeKnown(sharing, all, take);
    const double done = count > 0 ? 1.0 - static_cast<double>(left.size()) / static_cast<double>(count) : 0.0;
    sharing.loop(
      left.size(), context,
      [&](std::size_t i)
      {
        body(left[i]);
        this->part(std::to_string(left[i])).note(bytesOf(left[i]));
      },
      [&](std::size_t i) { return bytesOf(left[i]); }, [&](std::size_t i, const std::string& bytes) { take(left[i], bytes); },
      message, from + done * (to - from), to);
  }

private:
  FindingsStore* Store = nullptr;
  std::string Name;
};

} // namespace cactus
