// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "growth/LabelImage.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace cactus
{

/// A box of samples of a label image: the first one and how many, per axis.
struct SampleRange
{
  std::array<int, 3> first{ { 0, 0, 0 } };
  std::array<int, 3> count{ { 0, 0, 0 } };
};

/// Memory for samples that are computed on demand.
struct LabelBuffer
{
  std::vector<std::int32_t> fibreId;
  std::vector<float> depth;
  std::shared_ptr<const void> held; ///< used instead by views of existing memory
};

/// Properties of a fibre that are known before any sample is computed.
struct FibreOutline
{
  std::int32_t fibreId = 0;
  double targetRadius = 0.0;                ///< µm
  double length = 0.0;                      ///< length of its centre line, µm, in and near the image
  std::array<int, 3> middle{ { 0, 0, 0 } }; ///< nearest sample to the centroid of that line; possibly outside the image
};

/// The fibres from which the samples of an image are computed.
class KnownFibres
{
public:
  virtual ~KnownFibres() = default;

  /// Returns all fibres, in any order.
  virtual std::vector<FibreOutline> outlines() const = 0;
  /// Returns all tiles of the image with samples of a fibre, and possibly others near it: the first sample divided by the edge of
  /// a tile, per axis. Each tile is listed once; none for an unknown id.
  virtual std::vector<std::array<int, 3>> tilesOf(std::int32_t fibreId) const = 0;
};

/// The source of a label image's samples. Thread-safe.
class LabelSource
{
public:
  virtual ~LabelSource() = default;

  /// Edge of the tiles in which samples are best requested; they begin at multiples of it in the image.
  static constexpr int tileEdge = 16;

  /// Returns the grid of the whole image.
  virtual const VoxelGrid& grid() const = 0;
  /// Returns the distance (µm) that growth kept between two fibres; see FibreRadialGrowthOptions::gap().
  virtual double gap() const = 0;
  /// Returns a view of at least the samples of `range`, all inside the image. It is valid until `buffer`, of which each thread
  /// has its own, is used again.
  virtual LabelImageView samples(const SampleRange& range, LabelBuffer& buffer) const = 0;
  /// Returns null if fibres are known only from the samples.
  virtual const KnownFibres* knownFibres() const { return nullptr; }
};

/// A view of a whole image in memory.
class LabelImageInMemory : public LabelSource
{
public:
  explicit LabelImageInMemory(const LabelImageView& image)
    : Image(image)
  {
  }

  const VoxelGrid& grid() const override { return this->Image.grid; }
  double gap() const override { return this->Image.gap; }
  LabelImageView samples(const SampleRange&, LabelBuffer&) const override { return this->Image; }

private:
  LabelImageView Image;
};

} // namespace cactus
