// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BandExcesses.h"

#include <Eigen/Core>

#include <algorithm>
#include <numeric>

namespace cactus
{

namespace
{

/// One of this many triangles of a contour is evaluated.
constexpr std::size_t lookEvery = 3;
constexpr double unknown = -1.0;

} // namespace

BandExcesses::BandExcesses(const CappedSurface& surface, const PlaneLoops& loops, const SurfaceDecimationOptions& options)
  : Surface(surface)
  , Options(options)
  , Begins(loops.bandCount() + 1, 0)
  , Known(loops.bandCount(), unknown)
{
  const std::size_t count = surface.mesh.triangles.size();
  for (std::size_t t = 0; t < count; t += lookEvery)
  {
    ++this->Begins[loops.bandOf(t) + 1];
  }
  std::partial_sum(this->Begins.begin(), this->Begins.end(), this->Begins.begin());
  this->Triangles.resize(this->Begins.back());
  std::vector<std::size_t> next(this->Begins.begin(), this->Begins.end() - 1);
  for (std::size_t t = 0; t < count; t += lookEvery)
  {
    this->Triangles[next[loops.bandOf(t)]++] = static_cast<std::uint32_t>(t);
  }
}

double BandExcesses::in(std::size_t band) const
{
  double& largest = this->Known[band];
  if (largest == unknown)
  {
    largest = 0.0;
    const auto& points = this->Surface.mesh.points;
    for (std::size_t i = this->Begins[band]; i < this->Begins[band + 1]; ++i)
    {
      const auto& t = this->Surface.mesh.triangles[this->Triangles[i]];
      if (!this->Surface.isCap(t))
      {
        const Eigen::Vector3d middle = (points[std::size_t(t[0])] + points[std::size_t(t[1])] + points[std::size_t(t[2])]) / 3.0;
        largest = std::max(largest, this->Options.field(middle) - this->Options.level);
      }
    }
  }
  return largest;
}

} // namespace cactus
