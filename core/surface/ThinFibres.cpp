// SPDX-License-Identifier: BSD-3-Clause
#include "surface/ThinFibres.h"

#include "base/Bytes.h"

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

/// Slices, and rows of each, that are looked at together.
constexpr int sliceCount = 16;
constexpr int rowCount = 16;

/// Adds what one row of samples holds, run by run.
void addRow(const std::int32_t* fibreId, const float* depth, int count, DepthsOfFibres& depths)
{
  for (int i = 0; i < count;)
  {
    const std::int32_t id = fibreId[i];
    Depths run;
    for (; i < count && fibreId[i] == id; ++i)
    {
      run.sum += double(depth[i]);
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

/// Of each of some slices.
std::vector<DepthsOfFibres> depthsInSlices(const FibreField& field, int first, int slices)
{
  const SampleBox& samples = field.samples();
  std::vector<DepthsOfFibres> depths(static_cast<std::size_t>(slices));
  LabelBuffer buffer;
  for (int j0 = 0; j0 < samples.count[1]; j0 += rowCount)
  {
    // Node 1 is the first sample.
    const int rows = std::min(rowCount, samples.count[1] - j0);
    const LabelImageView held =
      field.samplesAt({ { { 1, j0 + 1, first + 1 } }, { { samples.count[0], rows, slices } } }, 0, buffer);
    for (int k = 0; k < slices; ++k)
    {
      for (int j = j0; j < j0 + rows; ++j)
      {
        const std::size_t row = held.grid.index(samples.first[0], samples.first[1] + j, samples.first[2] + first + k);
        addRow(held.fibreId + row, held.depth + row, samples.count[0], depths[static_cast<std::size_t>(k)]);
      }
    }
  }
  return depths;
}

std::string bytesOfSlices(const std::vector<DepthsOfFibres>& slices)
{
  ByteWriter put;
  for (const DepthsOfFibres& slice : slices)
  {
    put(static_cast<std::uint64_t>(slice.size()));
    for (const auto& [id, part] : slice)
    {
      put(id);
      put(part.sum);
      put(part.count);
    }
  }
  return put.bytes();
}

std::vector<DepthsOfFibres> slicesFrom(const std::string& bytes)
{
  std::vector<DepthsOfFibres> slices;
  for (ByteReader get(bytes); !get.isAtEnd();)
  {
    DepthsOfFibres& slice = slices.emplace_back();
    for (auto count = get.get<std::uint64_t>(); count > 0; --count)
    {
      Depths& part = slice[get.get<std::int32_t>()];
      get(part.sum);
      get(part.count);
    }
  }
  return slices;
}

/// How many layers to look at before their slices are added up: some for each thread of all processes, but not so many that what
/// is known of them grows with the processes.
int layersTogether(const Context& context, const Sharing& sharing)
{
  std::vector<std::uint64_t> threads{ static_cast<std::uint64_t>(context.threadCount()) };
  sharing.addUp(threads);
  const int all = static_cast<int>(threads.front());
  return std::max(all, std::min(4 * all, 32));
}

/// Of all slices, added up one after the other.
std::map<std::int32_t, Depths> depthsOfAll(const FibreField& field, const Context& context, const Sharing& sharing)
{
  const int count = field.samples().count[2];
  const int layers = (count + sliceCount - 1) / sliceCount;
  const int together = layersTogether(context, sharing);
  std::map<std::int32_t, Depths> all;
  for (int layer = 0; layer < layers; layer += together)
  {
    std::vector<std::vector<DepthsOfFibres>> ofLayer(static_cast<std::size_t>(std::min(together, layers - layer)));
    sharing.loop(
      ofLayer.size(), context,
      [&](std::size_t i)
      {
        const int first = sliceCount * (layer + static_cast<int>(i));
        ofLayer[i] = depthsInSlices(field, first, std::min(sliceCount, count - first));
      },
      [&](std::size_t i) { return bytesOfSlices(ofLayer[i]); },
      [&](std::size_t i, const std::string& bytes) { ofLayer[i] = slicesFrom(bytes); });
    for (const auto& slices : ofLayer)
    {
      for (const DepthsOfFibres& slice : slices)
      {
        for (const auto& [id, part] : slice)
        {
          all[id].sum += part.sum;
          all[id].count += part.count;
        }
      }
    }
  }
  return all;
}

} // namespace

ThinFibres::ThinFibres(const FibreField& field, const Context& context, const Sharing& sharing)
  : Field(field)
{
  for (const auto& [id, all] : depthsOfAll(field, context, sharing))
  {
    const double radius = 3.0 * all.sum / (all.count * field.grid().spacing);
    const double part = (radius - sparedRadius) / (smoothedRadius - sparedRadius);
    if (part < 1.0)
    {
      Smoothing[id] = static_cast<float>(std::max(part, 0.0));
    }
  }
}

bool ThinFibres::smoothingInside(const NodeRange& range, float* out) const
{
  thread_local LabelBuffer buffer;
  const LabelImageView held = this->Field.samplesAt(range, 0, buffer);
  const SampleBox& samples = this->Field.samples();
  const SampleRow row = samples.rowOf(range);
  bool any = false;
  std::int32_t last = 0;
  float part = outsideFibres;
  for (int k = 0; k < range.count[2]; ++k)
  {
    const int z = samples.sampleOf(2, range.first[2] + k);
    for (int j = 0; j < range.count[1]; ++j, out += row.nodes())
    {
      const std::int32_t* ids = held.fibreId + held.grid.index(row.first, samples.sampleOf(1, range.first[1] + j), z);
      for (int i = 0; i < row.count; ++i)
      {
        if (ids[i] != last)
        {
          last = ids[i];
          const auto found = this->Smoothing.find(last);
          part = last == 0 ? outsideFibres : found == this->Smoothing.end() ? 1.0f : found->second;
          any = any || part < 1.0f;
        }
        out[row.before + i] = part;
      }
      row.fillRim(out);
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
  const std::size_t rows(range.count[0]);
  const std::size_t slices = rows * std::size_t(range.count[1]);
  std::transform(inside.begin(), inside.end(), out, [](float own) { return std::min(own, 1.0f); });
  for (std::size_t n = slices; n + slices < range.size(); ++n)
  {
    // Beside a fibre as in it.
    const float* at = inside.data() + n;
    const float alongX = std::min(at[-1], at[1]);
    const float alongY = std::min(at[-std::ptrdiff_t(rows)], at[rows]);
    const float alongZ = std::min(at[-std::ptrdiff_t(slices)], at[slices]);
    const float beside = std::min(std::min(alongX, alongY), std::min(alongZ, 1.0f));
    out[n] = *at == outsideFibres ? beside : out[n];
  }
  return true;
}

} // namespace cactus
