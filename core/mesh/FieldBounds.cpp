// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/FieldBounds.h"

#include <cmath>

namespace cactus
{

using Eigen::Vector3d;

bool FieldBounds::holdAt(const std::array<std::int32_t, 3>& triangle) const
{
  FieldFit fit;
  for (std::size_t i = 0; i < 3 && !fit.isOut(); ++i)
  {
    const std::int32_t a = triangle[i];
    const std::int32_t b = triangle[(i + 1) % 3];
    this->add(fit, this->Surface.at(a), this->Surface.facesOf(a), 1.0);
    this->add(fit, 0.5 * (this->Surface.at(a) + this->Surface.at(b)), this->Surface.facesOf(a) & this->Surface.facesOf(b), 1.0);
  }
  const std::uint8_t faces =
    this->Surface.facesOf(triangle[0]) & this->Surface.facesOf(triangle[1]) & this->Surface.facesOf(triangle[2]);
  this->add(
    fit, (this->Surface.at(triangle[0]) + this->Surface.at(triangle[1]) + this->Surface.at(triangle[2])) / 3.0, faces, 1.0);
  return !fit.isOut();
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
