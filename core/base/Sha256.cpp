// SPDX-License-Identifier: BSD-3-Clause
#include "base/Sha256.h"

#include <algorithm>
#include <cstring>

namespace cactus
{

namespace
{

// The first 32 bits of the fractional parts of the cube roots of the first 64 primes.
constexpr std::array<std::uint32_t, 64> roundConstants{ 0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1,
  0x923f82a4, 0xab1c5ed5, 0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
  0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da, 0x983e5152, 0xa831c66d,
  0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967, 0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13,
  0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85, 0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624,
  0xf40e3585, 0x106aa070, 0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
  0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2 };

constexpr std::uint32_t rotated(std::uint32_t word, int bits)
{
  return (word >> bits) | (word << (32 - bits));
}

} // namespace

void Sha256::mix(const unsigned char* block)
{
  std::array<std::uint32_t, 64> w;
  for (std::size_t t = 0; t < 16; ++t)
  {
    w[t] = static_cast<std::uint32_t>(block[4 * t]) << 24 | static_cast<std::uint32_t>(block[4 * t + 1]) << 16 |
           static_cast<std::uint32_t>(block[4 * t + 2]) << 8 | static_cast<std::uint32_t>(block[4 * t + 3]);
  }
  for (std::size_t t = 16; t < 64; ++t)
  {
    const std::uint32_t early = rotated(w[t - 15], 7) ^ rotated(w[t - 15], 18) ^ (w[t - 15] >> 3);
    const std::uint32_t late = rotated(w[t - 2], 17) ^ rotated(w[t - 2], 19) ^ (w[t - 2] >> 10);
    w[t] = w[t - 16] + early + w[t - 7] + late;
  }
  auto [a, b, c, d, e, f, g, h] = this->State;
  for (std::size_t t = 0; t < 64; ++t)
  {
    const std::uint32_t choice = (e & f) ^ (~e & g);
    const std::uint32_t majority = (a & b) ^ (a & c) ^ (b & c);
    const std::uint32_t first = h + (rotated(e, 6) ^ rotated(e, 11) ^ rotated(e, 25)) + choice + roundConstants[t] + w[t];
    const std::uint32_t second = (rotated(a, 2) ^ rotated(a, 13) ^ rotated(a, 22)) + majority;
    h = g;
    g = f;
    f = e;
    e = d + first;
    d = c;
    c = b;
    b = a;
    a = first + second;
  }
  const std::array<std::uint32_t, 8> mixed{ a, b, c, d, e, f, g, h };
  for (std::size_t i = 0; i < mixed.size(); ++i)
  {
    this->State[i] += mixed[i];
  }
}

void Sha256::add(const void* data, std::size_t size)
{
  const auto* bytes = static_cast<const unsigned char*>(data);
  this->Bytes += size;
  while (size > 0)
  {
    if (this->Filled == 0 && size >= this->Block.size())
    {
      this->mix(bytes);
      bytes += this->Block.size();
      size -= this->Block.size();
      continue;
    }
    const std::size_t taken = std::min(size, this->Block.size() - this->Filled);
    std::memcpy(this->Block.data() + this->Filled, bytes, taken);
    this->Filled += taken;
    bytes += taken;
    size -= taken;
    if (this->Filled == this->Block.size())
    {
      this->mix(this->Block.data());
      this->Filled = 0;
    }
  }
}

std::string Sha256::digest()
{
  const std::uint64_t bits = 8 * this->Bytes;
  const unsigned char one = 0x80;
  const unsigned char zero = 0;
  this->add(&one, 1);
  while (this->Filled != 56)
  {
    this->add(&zero, 1);
  }
  std::array<unsigned char, 8> length;
  for (std::size_t i = 0; i < length.size(); ++i)
  {
    length[i] = static_cast<unsigned char>(bits >> (56 - 8 * i));
  }
  this->add(length.data(), length.size());
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

std::string sha256(const std::string& text)
{
  Sha256 hash;
  hash.add(text.data(), text.size());
  return hash.digest();
}

} // namespace cactus
