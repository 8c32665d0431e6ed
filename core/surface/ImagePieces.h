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

/// The pieces of a label image that hold a field's samples, numbered with x fastest: the tiles of the image in which samples are
/// best asked for.
class ImagePieces
{
public:
  /// Of a piece, in samples.
  static constexpr int edge = LabelSource::tileEdge;

  /// Throws InvalidInput where there are more than their numbers count.
  explicit ImagePieces(const SampleBox& samples);

  std::size_t count() const { return std::size_t(this->Count[0]) * std::size_t(this->Count[1]) * std::size_t(this->Count[2]); }
  /// The place in the image at which a piece begins; its first samples may not be the field's.
  std::array<int, 3> begin(std::size_t piece) const;
  /// Those of the field.
  SampleRange samplesOf(std::size_t piece) const;
  /// The numbers of those that hold a box of the field's samples.
  std::vector<std::uint32_t> holding(const std::array<int, 3>& firstSample, const std::array<int, 3>& lastSample) const;
  /// The numbers, increasing, of those among some tiles of the image (see KnownFibres::tilesOf()) that hold samples of the field.
  std::vector<std::uint32_t> among(const std::vector<std::array<int, 3>>& tiles) const;

private:
  std::uint32_t number(const std::array<std::size_t, 3>& at) const;

  SampleBox Samples;
  std::array<int, 3> First{}; ///< piece along each axis
  std::array<int, 3> Count{};
};

} // namespace cactus
