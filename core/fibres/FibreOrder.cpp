// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/FibreOrder.h"

#include "fibres/SelectFibres.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace cactus
{

namespace
{

/// Returns the bits of a number below 2²¹, each followed by two zeros.
std::uint64_t spread(std::uint64_t x)
{
  x = (x | (x << 32)) & 0x001f00000000ffffu;
  x = (x | (x << 16)) & 0x001f0000ff0000ffu;
  x = (x | (x << 8)) & 0x100f00f00f00f00fu;
  x = (x | (x << 4)) & 0x10c30c30c30c30c3u;
  return (x | (x << 2)) & 0x1249249249249249u;
}

} // namespace

FibreOrder::FibreOrder(const Fibres& fibres)
  : Order(fibres.size())
{
  std::vector<Eigen::Vector3d> middles;
  Eigen::AlignedBox3d bounds;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      sum += fibres.points[i];
    }
    middles.push_back(sum / static_cast<double>(fibres.pointCount(f)));
    bounds.extend(middles.back());
  }
  constexpr double largest = (1 << 21) - 1;
  const double scale = largest / std::max(bounds.sizes().maxCoeff(), 1e-300);
  std::vector<std::uint64_t> codes;
  for (const Eigen::Vector3d& middle : middles)
  {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      code |= spread(static_cast<std::uint64_t>(std::min(scale * (middle[axis] - bounds.min()[axis]), largest))) << axis;
    }
    codes.push_back(code);
  }
  std::iota(this->Order.begin(), this->Order.end(), std::size_t(0));
  std::stable_sort(this->Order.begin(), this->Order.end(), [&](std::size_t a, std::size_t b) { return codes[a] < codes[b]; });
  this->Points.reserve(fibres.points.size());
  for (const std::size_t f : this->Order)
  {
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      this->Points.push_back(i);
    }
  }
}

Fibres FibreOrder::ordered(const Fibres& fibres) const
{
  return selectFibres(fibres, this->Order);
}

} // namespace cactus
