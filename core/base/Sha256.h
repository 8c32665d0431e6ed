// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace cactus
{

/// The SHA-256 checksum (FIPS 180-4) of bytes added piece by piece; equal to the output of `sha256sum`.
class Sha256
{
public:
  void add(const void* data, std::size_t size);
  /// Returns 64 hexadecimal digits for all bytes added. Call it once, last.
  std::string digest();

private:
  void mix(const unsigned char* block);

  std::array<std::uint32_t, 8> State{ 0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab,
    0x5be0cd19 };
  std::array<unsigned char, 64> Block{};
  std::size_t Filled = 0;  ///< bytes in Block
  std::uint64_t Bytes = 0; ///< bytes added
};

/// Returns the checksum of a text.
std::string sha256(const std::string& text);

} // namespace cactus
