// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

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

/// Appends the number's bytes, the lowest first, as most file formats have them.
template <typename Number>
void appendLittleEndian(std::string& bytes, Number number)
{
  if (!isLittleEndian())
  {
    swapBytes(&number, 1);
  }
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

} // namespace cactus
