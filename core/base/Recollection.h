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

/// Keeps what parts of a long work have found, as bytes by the parts' names, for a run that does the same work again.
class FindingsStore
{
public:
  virtual ~FindingsStore() = default;

  /// What an earlier run has kept, once. Never from several threads.
  virtual std::optional<std::string> take(const std::string& name) = 0;
  /// Several threads may keep. Throws FileError.
  virtual void keep(const std::string& name, const std::string& bytes) = 0;
};

/// What an earlier run has found in a part of a work, so that it need not be looked for again. By itself nothing is known, and
/// nothing kept.
class Recollection
{
public:
  Recollection() = default;
  /// Which outlives all that is made of this.
  explicit Recollection(FindingsStore& store)
    : Store(&store)
  {
  }

  /// Of a part of this part.
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

  /// What compute() gives, for which all processes come together, or what is known of it; bytesOf(result), which are not empty,
  /// and from(bytes) turn into each other.
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

  /// Sharing::loop() of those i alone that are not known; take(i, bytes), one after the other, of those that are.
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
    sharing.addUp(isKnown); // a process may know of some that others do not
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
