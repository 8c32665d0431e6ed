// SPDX-License-Identifier: BSD-3-Clause
#include "growth/GrownField.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cactus
{

namespace
{

constexpr double bandInVoxels = 4.0;

/// Where growth is uneven, the second largest field matters outside fibres, too, as far as depths are known.
FieldRelevance relevanceOf(double growth, double band, double halfGap, bool isUneven)
{
  const double beside = isUneven ? band : halfGap;
  FieldRelevance relevance;
  relevance.bestReach = growth + band;
  relevance.secondReach = growth + beside;
  relevance.sumReach = 2.0 * (growth + beside);
  return relevance;
}

/// Returns the distance within which seeds matter.
double reachOf(const Fibres& fibres, const FieldRelevance& relevance, double spacing)
{
  const double largestRadius = *std::max_element(fibres.radii.begin(), fibres.radii.end());
  return std::max(0.0, std::max(relevance.bestReach, largestRadius + relevance.sumReach) + 2.0 * spacing);
}

} // namespace

GrownField::GrownField(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part, int threads)
  : Part(part)
  , HalfGap(0.5 * options.gap())
  , Band(std::max(bandInVoxels * Part.spacing, HalfGap))
  , Relevance(relevanceOf(growth, Band, HalfGap, slowsBare(fibres, options)))
  , Seeds(fibres, seedOptions(fibres, options), Part.box(), reachOf(fibres, Relevance, Part.spacing), threads)
  , Growth(fibres, options, Seeds, growth)
{
  for (std::size_t rank = 0; rank < this->Seeds.size(); ++rank)
  {
    const std::size_t f = this->Seeds.fibre(static_cast<int>(rank));
    this->IdOfRank.push_back(fibres.fibreIds[f]);
    this->RadiusOfRank.push_back(fibres.targetRadii[f]);
  }
}

FibreOutline GrownField::outline(int rank) const
{
  FibreOutline outline;
  outline.fibreId = this->IdOfRank[static_cast<std::size_t>(rank)];
  outline.targetRadius = this->RadiusOfRank[static_cast<std::size_t>(rank)];
  Eigen::Vector3d middle = this->Part.box().center();
  outline.length = this->Seeds.length(rank, middle);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto a = Eigen::Index(axis);
    outline.middle[axis] = static_cast<int>(std::lround((middle[a] - this->Part.origin[a]) / this->Part.spacing));
  }
  return outline;
}

int GrownField::rankOf(std::int32_t fibreId) const
{
  const auto found = std::lower_bound(this->IdOfRank.begin(), this->IdOfRank.end(), fibreId);
  return found != this->IdOfRank.end() && *found == fibreId ? static_cast<int>(found - this->IdOfRank.begin()) : -1;
}

std::vector<std::array<int, 3>> GrownField::blocksOf(int rank) const
{
  // A sample is in a fibre only if its seed's field is above -growth, see enter().
  return this->Seeds.blocksNear(rank, this->Part, this->Growth(rank));
}

void GrownField::enter(const FieldCell& cell, const VoxelGrid& held, std::int32_t* fibreId, float* depth) const
{
  const auto g = static_cast<float>(this->Growth.common());
  const auto w = static_cast<float>(this->HalfGap);
  const auto lowest = static_cast<float>(-this->Band);
  std::array<float, FieldCell::size> fields;
  for (int n = 0; n < FieldCell::size; ++n)
  {
    const float alone = cell.best[n] + g;
    const float beside = 0.5f * (cell.best[n] - cell.second[n]) - w;
    fields[std::size_t(n)] = alone < beside ? alone : beside;
  }
  for (int n = 0; n < FieldCell::size && this->Growth.isUneven(); ++n)
  {
    // Outside a fibre that has grown less, the field of its neighbour can be the largest.
    float& field = fields[std::size_t(n)];
    const float own = cell.best[n] + static_cast<float>(this->Growth(cell.rank[n]));
    const float neighbour = std::min(cell.second[n] + g, 0.5f * (cell.second[n] - cell.best[n]) - w);
    field = std::max(std::min(field, own), neighbour);
  }
  for (int k = cell.begin[2]; k < cell.end[2]; ++k)
  {
    for (int j = cell.begin[1]; j < cell.end[1]; ++j)
    {
      const int row = FieldCell::edge * (j + FieldCell::edge * k);
      const std::size_t out = held.index(cell.lower[0] + cell.begin[0], cell.lower[1] + j, cell.lower[2] + k);
      std::int32_t* ids = fibreId + out;
      float* depths = depth + out;
      for (int i = row + cell.begin[0]; i < row + cell.end[0]; ++i, ++ids, ++depths)
      {
        const float f = fields[std::size_t(i)];
        const std::int32_t id = this->IdOfRank[static_cast<std::size_t>(std::max(cell.rank[i], 0))];
        *ids = f > 0.0f ? id : 0; // branch-free
        *depths = std::max(f, lowest);
      }
    }
  }
}

} // namespace cactus
