// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/FieldBounds.h"

#include <cmath>

namespace cactus
{

using Eigen::Vector3d;

double FieldBounds::excessAt(std::int32_t point) const
{
  FieldFit fit;
  const std::uint8_t faces = this->Surface.facesOf(point);
  this->add(fit, this->Surface.at(point), faces, 1.0);
  for (std::int32_t c = this->Surface.firstCorner(point); c >= 0; c = this->Surface.nextCorner(c))
  {
    this->addTriangle(fit, this->Surface.at(point), faces, this->Surface.oppositeEdge(c));
  }
  return fit.excess;
}

bool FieldBounds::holdWithin(const std::array<Vector3d, 3>& corners, const std::array<std::uint8_t, 3>& faces) const
{
  const double longest = std::sqrt(std::max({ (corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[1]).squaredNorm(),
    (corners[0] - corners[2]).squaredNorm() }));
  const int n = 2 + static_cast<int>(longest / this->Sampling);
  for (int i = 0; n > 2 && i < n; ++i)
  {
    for (int j = i == 0 ? 1 : 0; i + j <= n && j < n; ++j)
    {
      const int k = n - i - j;
      const std::uint8_t on = (i > 0 ? faces[0] : 0xff) & (j > 0 ? faces[1] : 0xff) & (k > 0 ? faces[2] : 0xff);
      FieldFit one;
      this->add(one, (double(i) / n) * corners[0] + (double(j) / n) * corners[1] + (double(k) / n) * corners[2], on, 1.0);
      if (one.isOut())
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
      return EditableSurface::outlivesCollapse(edge, u, v) &&
             !this->holdWithin({ { place, this->Surface.at(edge[0]), this->Surface.at(edge[1]) } },
               { { facesOfBoth, this->Surface.facesOf(edge[0]), this->Surface.facesOf(edge[1]) } });
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
