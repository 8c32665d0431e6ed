// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/FieldBounds.h"

#include <Eigen/Geometry>

#include <cmath>

namespace cactus
{

using Eigen::Vector3d;

TriangleExcess FieldBounds::excessOf(const std::array<std::int32_t, 3>& triangle) const
{
  TriangleExcess excess;
  Vector3d sum = Vector3d::Zero();
  std::uint8_t common = 0xff;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Vector3d& a = this->Surface.at(triangle[i]);
    const std::int32_t next = triangle[(i + 1) % 3];
    const std::uint8_t faces = this->Surface.facesOf(triangle[i]);
    excess.inMiddles[i] =
      static_cast<float>(this->excessAt(0.5 * (a + this->Surface.at(next)), faces & this->Surface.facesOf(next)));
    sum += a;
    common &= faces;
  }
  excess.inCentroid = static_cast<float>(this->excessAt(sum / 3.0, common));
  return excess;
}

bool FieldBounds::holdAlong(const Vector3d& a, const Vector3d& b, std::uint8_t faces) const
{
  const int n = 2 + static_cast<int>((b - a).norm() / this->Sampling);
  for (int i = 1; n > 2 && i < n; ++i)
  {
    if (2 * i != n && this->excessAt(a + (double(i) / n) * (b - a), faces) > 0.0)
    {
      return false;
    }
  }
  return true;
}

bool FieldBounds::holdWithin(const std::array<Vector3d, 3>& corners, std::uint8_t faces) const
{
  const double longest = std::sqrt(std::max({ (corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[1]).squaredNorm(),
    (corners[0] - corners[2]).squaredNorm() }));
  const double height = (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() / longest;
  const int n = 2 + static_cast<int>(longest / this->Sampling);
  for (int i = 1; 2.0 * height > this->Sampling && i < n; ++i)
  {
    for (int j = 1; i + j < n; ++j)
    {
      const int k = n - i - j;
      if (this->excessAt((double(i) / n) * corners[0] + (double(j) / n) * corners[1] + (double(k) / n) * corners[2], faces) > 0.0)
      {
        return false;
      }
    }
  }
  return true;
}

bool FieldBounds::holdAfterCollapse(std::int32_t u, std::int32_t v, const Vector3d& place) const
{
  const std::uint8_t facesOfBoth = this->Surface.facesOf(u) | this->Surface.facesOf(v);
  return !this->Surface.visitCornersAt(u, v,
    [&](std::int32_t c, std::int32_t)
    {
      const std::array<std::int32_t, 2> edge = this->Surface.oppositeEdge(c);
      if (!EditableSurface::outlivesCollapse(edge, u, v))
      {
        return false;
      }
      const Vector3d& a = this->Surface.at(edge[0]);
      const Vector3d& b = this->Surface.at(edge[1]);
      const std::uint8_t facesOfEdge = facesOfBoth & this->Surface.facesOf(edge[0]);
      return !this->holdAlong(place, a, facesOfEdge) ||
             !this->holdWithin({ { place, a, b } }, facesOfEdge & this->Surface.facesOf(edge[1]));
    });
}

double FieldBounds::largestError(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d, double limit) const
{
  double largest = 0.0;
  for (const Vector3d& p : { Vector3d((a + b) / 2.0), Vector3d((a + b + c) / 3.0), Vector3d((a + b + d) / 3.0) })
  {
    largest = std::max(largest, std::abs(this->Value(p) - this->Level));
    if (largest > limit)
    {
      break;
    }
  }
  return largest;
}

} // namespace cactus
