// SPDX-License-Identifier: BSD-3-Clause
#include "surface/ThinFibres.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace cactus
{

namespace
{

/// Radii, in voxels, up to which smoothing spares a fibre entirely and from which on it does not.
constexpr double sparedRadius = 2.0;
constexpr double smoothedRadius = 4.0;
constexpr float outsideFibres = 2.0f;

} // namespace

ThinFibres::ThinFibres(const FibreField& field, const FoundFibres& fibres)
  : Field(field)
{
  for (const auto& [id, fibre] : fibres)
  {
    const double radius = 3.0 * fibre.depths / (fibre.samples * field.grid().spacing);
    const double part = (radius - sparedRadius) / (smoothedRadius - sparedRadius);
    if (part < 1.0)
    {
      Smoothing[id] = static_cast<float>(std::max(part, 0.0));
      for (const FoundBox& box : fibre.boxes)
      {
        HoldsSome.resize(std::max(HoldsSome.size(), std::size_t(box.piece) + 1));
        HoldsSome[box.piece] = true;
      }
    }
  }
}

bool ThinFibres::smoothingInside(const NodeRange& range, const LabelImageView& held, float* out) const
{
  const SampleBox& samples = this->Field.samples();
  const SampleRow row = samples.rowOf(range);
  // A cache of recent look-ups, by the last bits of ids: there are few fibres in a range.
  struct Known
  {
    std::int32_t id = 0;
    float part = outsideFibres;
  };
  std::array<Known, 256> known{};
  bool any = false;
  for (int k = 0; k < range.count[2]; ++k)
  {
    const int z = samples.sampleOf(2, range.first[2] + k);
    for (int j = 0; j < range.count[1]; ++j, out += row.nodes())
    {
      const std::int32_t* ids = held.fibreId + held.grid.index(row.first, samples.sampleOf(1, range.first[1] + j), z);
      for (int i = 0; i < row.count; ++i)
      {
        Known& here = known[std::size_t(ids[i]) % known.size()];
        if (here.id != ids[i])
        {
          const auto found = this->Smoothing.find(ids[i]);
          here = { ids[i], ids[i] == 0 ? outsideFibres : found == this->Smoothing.end() ? 1.0f : found->second };
          any = any || here.part < 1.0f;
        }
        out[row.before + i] = here.part;
      }
      row.fillRim(out);
    }
  }
  return any;
}

bool ThinFibres::areNear(const NodeRange& range) const
{
  if (this->HoldsSome.empty() || range.size() == 0)
  {
    return false;
  }
  const std::vector<std::uint32_t> pieces = piecesAt(this->Field, range);
  return std::any_of(
    pieces.begin(), pieces.end(), [&](std::uint32_t piece) { return piece < this->HoldsSome.size() && this->HoldsSome[piece]; });
}

bool ThinFibres::smoothingAt(const NodeRange& range, const LabelImageView& held, float* out) const
{
  std::vector<float> inside(range.size());
  if (!this->areNear(range) || !this->smoothingInside(range, held, inside.data()))
  {
    return false;
  }
  const std::size_t rows(range.count[0]);
  const std::size_t slices = rows * std::size_t(range.count[1]);
  std::transform(
    inside.begin(), inside.begin() + std::ptrdiff_t(range.size()), out, [](float own) { return std::min(own, 1.0f); });
  for (std::size_t n = slices; n + slices < range.size(); ++n)
  {
    // Nodes beside a fibre are treated like those in it.
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
