// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace cactus
{

/// The SHA-256 checksum of a sequence of bytes (FIPS 180-4), given piece by piece; what `sha256sum` prints.
class Sha256
{
public:
  void add(const void* data, std::size_t size);
  /// 64 hexadecimal digits, of all that was added. Call it once, last.
  std::string digest();

private:
  void mix(const unsigned char* block);

  std::array<std::uint32_t, 8> State{ 0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab,
    0x5be0cd19 };
  std::array<unsigned char, 64> Block{};
  std::size_t Filled = 0;  ///< bytes of Block
  std::uint64_t Bytes = 0; ///< added so far
};

/// The checksum of a text.
std::string sha256(const std::string& text);

/// The checksum of a file; nothing where it cannot be read.
std::optional<std::string> sha256OfFile(const std::string& path);

} // namespace cactus
