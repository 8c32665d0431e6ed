// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace cactus
{

/// A checksum of 64 bits, to know large data again by: as fast as memory is read, and no protection against intent. The same on
/// every little-endian machine.
class FastChecksum
{
public:
  void add(const void* data, std::size_t size);
  void add(std::uint64_t number) { this->add(&number, sizeof(number)); }
  /// 16 hexadecimal digits, of all that was added. What was added in other pieces has another checksum.
  std::string digest() const;

private:
  std::array<std::uint64_t, 4> Lanes{ 0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89 };
};

} // namespace cactus
