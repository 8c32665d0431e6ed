// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cactus
{

/// Whether this machine has the lowest byte of a number first.
inline bool isLittleEndian()
{
  const std::uint16_t one = 1;
  unsigned char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

/// Turns the order of bytes in each of `count` numbers.
template <typename Number>
void swapBytes(Number* numbers, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    auto* bytes = reinterpret_cast<unsigned char*>(numbers + i);
    std::reverse(bytes, bytes + sizeof(Number));
  }
}

} // namespace cactus
