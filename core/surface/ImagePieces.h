// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "growth/LabelSource.h"
#include "surface/FibreField.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// The pieces of a label image that hold a field's samples, numbered with x fastest: the image's tiles, in which samples are best
/// requested.
class ImagePieces
{
public:
  /// Edge of a piece, in samples.
  static constexpr int edge = LabelSource::tileEdge;

  /// Throws InvalidInput if there are more pieces than 32-bit numbers.
  explicit ImagePieces(const SampleBox& samples);

  std::size_t count() const { return std::size_t(this->Count[0]) * std::size_t(this->Count[1]) * std::size_t(this->Count[2]); }
  /// Returns the first sample of a piece in the image; it may lie outside the field.
  std::array<int, 3> begin(std::size_t piece) const;
  /// Returns the field's samples in a piece.
  SampleRange samplesOf(std::size_t piece) const;
  /// Returns the numbers of the pieces that overlap a box of the field's samples.
  std::vector<std::uint32_t> holding(const std::array<int, 3>& firstSample, const std::array<int, 3>& lastSample) const;
  /// Returns the numbers, increasing, of those tiles of the image (see KnownFibres::tilesOf()) that hold samples of the field.
  std::vector<std::uint32_t> among(const std::vector<std::array<int, 3>>& tiles) const;

private:
  std::uint32_t number(const std::array<std::size_t, 3>& at) const;

  SampleBox Samples;
  std::array<int, 3> First{}; ///< first piece along each axis
  std::array<int, 3> Count{};
};

} // namespace cactus
