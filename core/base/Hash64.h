// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

struct XXH3_state_s;

namespace cactus
{

/// A hash of 64 bits (XXH3 of xxHash) of bytes added piece by piece, in pieces of any size. It tells damage and mistakes, but is
/// no protection against intent.
class Hash64
{
public:
  /// Throws std::bad_alloc.
  Hash64();
  void add(const void* data, std::size_t size);
  void add(std::uint64_t number) { this->add(&number, sizeof(number)); }
  /// Returns the hash of all bytes added.
  std::uint64_t value() const;
  static constexpr char prefix[] = "xxh3-";
  /// Returns it as text: the prefix and up to 16 hexadecimal digits.
  std::string text() const;

private:
  std::unique_ptr<XXH3_state_s, void (*)(XXH3_state_s*)> State;
};

/// Returns the hash of some bytes; each `seed` gives another one.
std::uint64_t hash64(const void* data, std::size_t size, std::uint64_t seed = 0);

} // namespace cactus
