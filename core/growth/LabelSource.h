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

/// Room for samples that are made when they are asked for.
struct LabelBuffer
{
  std::vector<std::int32_t> fibreId;
  std::vector<float> depth;
  std::shared_ptr<const void> held; ///< instead of room: what a view shows a part of
};

/// What is known of a fibre before any sample is made.
struct FibreOutline
{
  std::int32_t fibreId = 0;
  double targetRadius = 0.0;                ///< µm
  double length = 0.0;                      ///< of its centre line, µm, in and near the image
  std::array<int, 3> middle{ { 0, 0, 0 } }; ///< of that: the sample nearest to it; it may be outside the image
};

/// The fibres of an image whose samples are made of them.
class KnownFibres
{
public:
  virtual ~KnownFibres() = default;

  /// All, in any order.
  virtual std::vector<FibreOutline> outlines() const = 0;
  /// All tiles of the image that hold samples of a fibre, and maybe others near it: the first sample by the edge of a tile, per
  /// axis. Each is there once. Of an id that no fibre has, none.
  virtual std::vector<std::array<int, 3>> tilesOf(std::int32_t fibreId) const = 0;
};

/// Where the samples of a label image come from. May be used from several threads.
class LabelSource
{
public:
  virtual ~LabelSource() = default;

  /// Edge of the tiles in which samples are best asked for; they begin at its multiples in the image.
  static constexpr int tileEdge = 16;

  /// The whole image.
  virtual const VoxelGrid& grid() const = 0;
  /// µm, the room that growth kept between two fibres; see FibreRadialGrowthOptions::gap().
  virtual double gap() const = 0;
  /// A view that holds the samples of `range`, of which none is outside the image, and maybe others. It is good until `buffer`,
  /// which each thread has one of its own of, is used again.
  virtual LabelImageView samples(const SampleRange& range, LabelBuffer& buffer) const = 0;
  /// Null where only samples tell.
  virtual const KnownFibres* knownFibres() const { return nullptr; }
};

/// All of an image, held by somebody else.
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
