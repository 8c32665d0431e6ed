// SPDX-License-Identifier: BSD-3-Clause
#include "base/Hash64.h"

#include <array>
#include <charconv>
#include <new>
#include <xxhash.h>

namespace cactus
{

Hash64::Hash64()
  : State(XXH3_createState(), [](XXH3_state_s* state) { XXH3_freeState(state); })
{
  if (this->State == nullptr)
  {
    throw std::bad_alloc();
  }
  XXH3_64bits_reset(this->State.get());
}

void Hash64::add(const void* data, std::size_t size)
{
  if (size > 0) // xxHash takes no null pointer
  {
    XXH3_64bits_update(this->State.get(), data, size);
  }
}

std::uint64_t Hash64::value() const
{
  return XXH3_64bits_digest(this->State.get());
}

std::string Hash64::text() const
{
  std::array<char, 16> digits{};
  return prefix + std::string(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), this->value(), 16).ptr);
}

std::uint64_t hash64(const void* data, std::size_t size, std::uint64_t seed)
{
  return XXH3_64bits_withSeed(data, size, seed);
}

} // namespace cactus
