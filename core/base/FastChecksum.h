// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace cactus
{

/// A checksum of 64 bits that identifies large data: as fast as memory is read, no protection against intent. It is the same on
/// every little-endian machine. Records of data have held it since version 0.2.0: with another one they would count as changed.
class FastChecksum
{
public:
  void add(const void* data, std::size_t size);
  void add(std::uint64_t number) { this->add(&number, sizeof(number)); }
  /// Returns 16 hexadecimal digits for all bytes added. The same bytes added in other pieces give another checksum.
  std::string digest() const;

private:
  std::array<std::uint64_t, 4> Lanes{ 0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89 };
};

} // namespace cactus
