// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

/// SHA-256 (FIPS 180-4) of numbers, by their bytes in little-endian order.
class Sha256
{
public:
  void addBytes(const void* data, std::size_t size)
  {
    const auto* bytes = static_cast<const unsigned char*>(data);
    this->Length += size;
    this->Rest.insert(this->Rest.end(), bytes, bytes + size);
    std::size_t done = 0;
    for (; done + 64 <= this->Rest.size(); done += 64)
    {
      this->block(this->Rest.data() + done);
    }
    this->Rest.erase(this->Rest.begin(), this->Rest.begin() + static_cast<std::ptrdiff_t>(done));
  }

  /// Numbers by value: −0 counts as 0, for which of the two comes out may depend on the vector unit.
  template <typename Number>
  void add(Number value)
  {
    static_assert(std::is_arithmetic_v<Number>);
    if (value == Number(0))
    {
      value = Number(0);
    }
    this->addBytes(&value, sizeof(value));
  }

  template <typename Number>
  void add(const std::vector<Number>& values)
  {
    for (const Number value : values)
    {
      this->add(value);
    }
  }

  /// 64 hexadecimal digits. Nothing can be added afterwards.
  std::string digest()
  {
    const std::uint64_t bits = 8 * this->Length;
    std::vector<unsigned char> end(1 + (119 - this->Length % 64) % 64, 0);
    end[0] = 0x80;
    for (int shift = 56; shift >= 0; shift -= 8)
    {
      end.push_back(static_cast<unsigned char>(bits >> shift));
    }
    this->addBytes(end.data(), end.size());
    std::string text;
    for (const std::uint32_t word : this->State)
    {
      for (int shift = 28; shift >= 0; shift -= 4)
      {
        text += "0123456789abcdef"[(word >> shift) & 15u];
      }
    }
    return text;
  }

private:
  static std::uint32_t rotated(std::uint32_t x, int n) { return (x >> n) | (x << (32 - n)); }

  void block(const unsigned char* bytes)
  {
    static constexpr std::uint32_t constants[64] = { 0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1,
      0x923f82a4, 0xab1c5ed5, 0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
      0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da, 0x983e5152, 0xa831c66d,
      0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967, 0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13,
      0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85, 0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624,
      0xf40e3585, 0x106aa070, 0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
      0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2 };
    std::uint32_t w[64];
    for (int t = 0; t < 16; ++t)
    {
      w[t] = std::uint32_t(bytes[4 * t]) << 24 | std::uint32_t(bytes[4 * t + 1]) << 16 | std::uint32_t(bytes[4 * t + 2]) << 8 |
             std::uint32_t(bytes[4 * t + 3]);
    }
    for (int t = 16; t < 64; ++t)
    {
      const std::uint32_t s0 = rotated(w[t - 15], 7) ^ rotated(w[t - 15], 18) ^ (w[t - 15] >> 3);
      const std::uint32_t s1 = rotated(w[t - 2], 17) ^ rotated(w[t - 2], 19) ^ (w[t - 2] >> 10);
      w[t] = w[t - 16] + s0 + w[t - 7] + s1;
    }
    std::array<std::uint32_t, 8> v = this->State;
    for (int t = 0; t < 64; ++t)
    {
      const std::uint32_t t1 = v[7] + (rotated(v[4], 6) ^ rotated(v[4], 11) ^ rotated(v[4], 25)) +
                               ((v[4] & v[5]) ^ (~v[4] & v[6])) + constants[t] + w[t];
      const std::uint32_t t2 =
        (rotated(v[0], 2) ^ rotated(v[0], 13) ^ rotated(v[0], 22)) + ((v[0] & v[1]) ^ (v[0] & v[2]) ^ (v[1] & v[2]));
      v = { { t1 + t2, v[0], v[1], v[2], v[3] + t1, v[4], v[5], v[6] } };
    }
    for (std::size_t i = 0; i < 8; ++i)
    {
      this->State[i] += v[i];
    }
  }

  std::array<std::uint32_t, 8> State{ { 0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab,
    0x5be0cd19 } };
  std::vector<unsigned char> Rest;
  std::uint64_t Length = 0;
};
