// SPDX-License-Identifier: BSD-3-Clause
#include "surface/ImagePieces.h"

#include "base/Error.h"

#include <algorithm>
#include <limits>

namespace cactus
{

namespace
{

/// Returns the piece of a sample along an axis; the sample may be negative.
int pieceOf(int sample)
{
  constexpr int edge = ImagePieces::edge;
  return sample >= 0 ? sample / edge : -((edge - 1 - sample) / edge);
}

} // namespace

ImagePieces::ImagePieces(const SampleBox& samples)
  : Samples(samples)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->First[axis] = pieceOf(samples.first[axis]);
    this->Count[axis] = pieceOf(samples.first[axis] + samples.count[axis] - 1) - this->First[axis] + 1;
  }
  require(this->count() <= std::numeric_limits<std::uint32_t>::max(),
    "the label image has more pieces of 16³ voxels than 32 bits count: choose a larger VoxelSize");
}

std::uint32_t ImagePieces::number(const std::array<std::size_t, 3>& at) const
{
  return std::uint32_t(at[0] + std::size_t(this->Count[0]) * (at[1] + std::size_t(this->Count[1]) * at[2]));
}

std::array<int, 3> ImagePieces::begin(std::size_t piece) const
{
  std::array<int, 3> at{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    at[axis] = edge * (this->First[axis] + int(piece % std::size_t(this->Count[axis])));
    piece /= std::size_t(this->Count[axis]);
  }
  return at;
}

SampleRange ImagePieces::samplesOf(std::size_t piece) const
{
  const std::array<int, 3> at = this->begin(piece);
  SampleRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    range.first[axis] = std::max(at[axis], this->Samples.first[axis]);
    range.count[axis] = std::min(at[axis] + edge, this->Samples.first[axis] + this->Samples.count[axis]) - range.first[axis];
  }
  return range;
}

std::vector<std::uint32_t> ImagePieces::holding(const std::array<int, 3>& firstSample, const std::array<int, 3>& lastSample) const
{
  std::array<std::size_t, 3> first{};
  std::array<std::size_t, 3> last{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    first[axis] = std::size_t(pieceOf(firstSample[axis]) - this->First[axis]);
    last[axis] = std::size_t(pieceOf(lastSample[axis]) - this->First[axis]);
  }
  std::vector<std::uint32_t> numbers;
  for (std::size_t z = first[2]; z <= last[2]; ++z)
  {
    for (std::size_t y = first[1]; y <= last[1]; ++y)
    {
      for (std::size_t x = first[0]; x <= last[0]; ++x)
      {
        numbers.push_back(this->number({ { x, y, z } }));
      }
    }
  }
  return numbers;
}

std::vector<std::uint32_t> ImagePieces::among(const std::vector<std::array<int, 3>>& tiles) const
{
  std::vector<std::uint32_t> numbers;
  for (const std::array<int, 3>& tile : tiles)
  {
    std::array<std::size_t, 3> at{};
    bool isHere = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      isHere = isHere && tile[axis] >= this->First[axis] && tile[axis] < this->First[axis] + this->Count[axis];
      at[axis] = std::size_t(tile[axis] - this->First[axis]);
    }
    if (isHere)
    {
      numbers.push_back(this->number(at));
    }
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

} // namespace cactus
