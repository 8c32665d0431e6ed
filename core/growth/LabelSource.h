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

/// Where the samples of a label image come from. May be used from several threads.
class LabelSource
{
public:
  virtual ~LabelSource() = default;

  /// The whole image.
  virtual const VoxelGrid& grid() const = 0;
  /// µm, the room that growth kept between two fibres; see FibreRadialGrowthOptions::gap().
  virtual double gap() const = 0;
  /// A view that holds the samples of `range`, of which none is outside the image, and maybe others. It is good until `buffer`,
  /// which each thread has one of its own of, is used again.
  virtual LabelImageView samples(const SampleRange& range, LabelBuffer& buffer) const = 0;
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
