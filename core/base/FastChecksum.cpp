// SPDX-License-Identifier: BSD-3-Clause
#include "base/FastChecksum.h"

#include <cstring>

namespace cactus
{

namespace
{

constexpr std::uint64_t factor = 0x9e3779b97f4a7c15; // odd: multiplying with it loses nothing

std::uint64_t mixed(std::uint64_t state, std::uint64_t word)
{
  state = (state ^ word) * factor;
  return state ^ (state >> 32);
}

} // namespace

void FastChecksum::add(const void* data, std::size_t size)
{
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::array<std::uint64_t, 4> words{};
  std::size_t done = 0;
  // Four lanes, so that each waits only for its own last multiplication.
  for (; done + sizeof(words) <= size; done += sizeof(words))
  {
    std::memcpy(words.data(), bytes + done, sizeof(words));
    for (std::size_t lane = 0; lane < words.size(); ++lane)
    {
      this->Lanes[lane] = mixed(this->Lanes[lane], words[lane]);
    }
  }
  words = {};
  if (done < size)
  {
    std::memcpy(words.data(), bytes + done, size - done);
  }
  for (std::size_t lane = 0; lane < words.size(); ++lane)
  {
    this->Lanes[lane] = mixed(this->Lanes[lane], words[lane]);
  }
  this->Lanes[0] = mixed(this->Lanes[0], size);
}

std::string FastChecksum::digest() const
{
  std::uint64_t sum = 0;
  for (const std::uint64_t lane : this->Lanes)
  {
    sum = mixed(sum, lane);
  }
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4)
  {
    text += digits[(sum >> shift) & 15];
  }
  return text;
}

} // namespace cactus
