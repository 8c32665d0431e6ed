// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Sharing.h"

#include <cstddef>
#include <cstdint>
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

  /// Returns the cached result, or else that of compute(), which all processes call together. bytesOf(result), never empty, and
  /// from(bytes) convert between result and bytes.
  template <typename Compute, typename BytesOf, typename From>
  auto once(const Sharing& sharing, Compute&& compute, BytesOf&& bytesOf, From&& from) const -> decltype(compute())
  {
    if (this->Store == nullptr)
    {
      return compute();
    }
    const std::string known = sharing.fromFirst(this->recall().value_or(std::string()));
    if (!known.empty())
    {
      return from(known);
    }
    auto result = compute();
    if (sharing.isFirst())
    {
      this->note(bytesOf(result));
    }
    return result;
  }

  /// Runs Sharing::loop() over the i without a cached result; calls take(i, bytes) for the others, one after the other.
  template <typename Body, typename BytesOf, typename Take>
  void loop(const Sharing& sharing, std::size_t count, const Context& context, Body&& body, BytesOf&& bytesOf, Take&& take,
    const std::string& message, double from, double to) const
  {
    if (this->Store == nullptr)
    {
      sharing.loop(count, context, body, bytesOf, take, message, from, to);
      return;
    }
    std::vector<std::uint64_t> isKnown(count, 0);
    for (std::size_t i = 0; i < count; ++i)
    {
      if (const std::optional<std::string> bytes = this->part(std::to_string(i)).recall())
      {
        take(i, *bytes);
        isKnown[i] = 1;
      }
    }
    sharing.addUp(isKnown); // one process may know results that others do not
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (isKnown[i] < std::uint64_t(sharing.size()))
      {
        left.push_back(i);
      }
    }
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
