// SPDX-License-Identifier: BSD-3-Clause
#include "surface/ThinFibres.h"

#include "base/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace cactus
{

namespace
{

/// Radii, in voxels, up to which smoothing spares a fibre altogether and from which on it does not.
constexpr double sparedRadius = 2.0;
constexpr double smoothedRadius = 4.0;
constexpr float outsideFibres = 2.0f;

struct Depths
{
  double sum = 0.0;
  double count = 0.0;
};

using DepthsOfFibres = std::unordered_map<std::int32_t, Depths>;

/// Of the samples of one slice, run by run.
DepthsOfFibres depthsInSlice(const FibreField& field, int slice)
{
  const LabelImageView& image = field.image();
  const SampleBox& samples = field.samples();
  DepthsOfFibres depths;
  for (int j = 0; j < samples.count[1]; ++j)
  {
    const std::size_t row = image.grid.index(samples.first[0], samples.first[1] + j, samples.first[2] + slice);
    const std::size_t end = row + std::size_t(samples.count[0]);
    for (std::size_t i = row; i < end;)
    {
      const std::int32_t id = image.fibreId[i];
      Depths run;
      for (; i < end && image.fibreId[i] == id; ++i)
      {
        run.sum += double(image.depth[i]);
        run.count += 1.0;
      }
      if (id != 0)
      {
        Depths& all = depths[id];
        all.sum += run.sum;
        all.count += run.count;
      }
    }
  }
  return depths;
}

} // namespace

ThinFibres::ThinFibres(const FibreField& field, const Context& context)
  : Field(field)
{
  std::vector<DepthsOfFibres> ofSlice(std::size_t(field.samples().count[2]));
  parallelFor(ofSlice.size(), context, [&](std::size_t k) { ofSlice[k] = depthsInSlice(field, static_cast<int>(k)); });
  std::map<std::int32_t, Depths> depths;
  for (const auto& slice : ofSlice)
  {
    for (const auto& [id, part] : slice)
    {
      depths[id].sum += part.sum;
      depths[id].count += part.count;
    }
  }
  for (const auto& [id, all] : depths)
  {
    const double radius = 3.0 * all.sum / (all.count * field.image().grid.spacing);
    const double part = (radius - sparedRadius) / (smoothedRadius - sparedRadius);
    if (part < 1.0)
    {
      Smoothing[id] = static_cast<float>(std::max(part, 0.0));
    }
  }
}

bool ThinFibres::smoothingInside(const NodeRange& range, float* out) const
{
  const LabelImageView& image = this->Field.image();
  const SampleBox& samples = this->Field.samples();
  const std::vector<int> columns = samples.columnsOf(range);
  bool any = false;
  std::int32_t last = 0;
  float part = outsideFibres;
  for (int k = 0; k < range.count[2]; ++k)
  {
    const int z = samples.sampleOf(2, range.first[2] + k);
    for (int j = 0; j < range.count[1]; ++j)
    {
      const std::int32_t* row = image.fibreId + image.grid.index(samples.first[0], samples.sampleOf(1, range.first[1] + j), z);
      for (const int column : columns)
      {
        const std::int32_t id = row[column];
        if (id != last)
        {
          const auto found = this->Smoothing.find(id);
          part = id == 0 ? outsideFibres : found == this->Smoothing.end() ? 1.0f : found->second;
          last = id;
          any = any || part < 1.0f;
        }
        *out++ = part;
      }
    }
  }
  return any;
}

bool ThinFibres::smoothingAt(const NodeRange& range, float* out) const
{
  std::vector<float> inside(this->Smoothing.empty() ? 0 : range.size());
  if (inside.empty() || !this->smoothingInside(range, inside.data()))
  {
    return false;
  }
  const std::size_t stride[3] = { 1, std::size_t(range.count[0]), std::size_t(range.count[0]) * std::size_t(range.count[1]) };
  std::transform(inside.begin(), inside.end(), out, [](float own) { return std::min(own, 1.0f); });
  for (std::size_t n = stride[2]; n + stride[2] < range.size(); ++n)
  {
    // Beside a fibre as in it.
    for (std::size_t axis = 0; axis < 3 && inside[n] == outsideFibres; ++axis)
    {
      out[n] = std::min({ out[n], inside[n - stride[axis]], inside[n + stride[axis]] });
    }
  }
  return true;
}

} // namespace cactus
