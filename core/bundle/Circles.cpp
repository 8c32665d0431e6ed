// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/Circles.h"

#include "base/Constants.h"

namespace cactus
{

double Circles::density() const
{
  double covered = 0.0;
  for (const double radius : radii)
  {
    covered += pi * radius * radius;
  }
  double available = 0.0;
  for (const Rectangle& rectangle : frames)
  {
    available += rectangle.area();
  }
  return covered / available;
}

Rectangle boundingRectangle(const std::vector<Rectangle>& frames)
{
  Rectangle all = frames.front();
  for (const Rectangle& frame : frames)
  {
    all.lower = all.lower.cwiseMin(frame.lower);
    all.upper = all.upper.cwiseMax(frame.upper);
  }
  return all;
}

} // namespace cactus
