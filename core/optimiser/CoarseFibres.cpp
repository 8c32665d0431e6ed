// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/CoarseFibres.h"

namespace cactus
{

namespace
{

/// Two segments are joined if their chord is at least this fraction of their length.
constexpr double nearlyStraight = 0.9;

bool canBeLeftOut(const std::vector<Eigen::Vector3d>& points, std::size_t i)
{
  const double along = (points[i] - points[i - 1]).norm() + (points[i + 1] - points[i]).norm();
  return (points[i + 1] - points[i - 1]).norm() > nearlyStraight * along;
}

} // namespace

CoarseFibres::CoarseFibres(const Fibres& fine)
  : Coarse(fine.emptyCopy())
{
  for (std::size_t f = 0; f < fine.size(); ++f)
  {
    this->Coarse.addFibre(fine, f);
    const std::size_t last = fine.offsets[f + 1] - 1;
    for (std::size_t i = fine.offsets[f]; i <= last; ++i)
    {
      this->Kept.push_back(i);
      this->Coarse.addPoint(fine.points[i], fine.radii[i]);
      if (i + 2 <= last && canBeLeftOut(fine.points, i + 1))
      {
        ++i;
      }
    }
  }
}

std::vector<Eigen::Vector3d> CoarseFibres::interpolate(const std::vector<Eigen::Vector3d>& values) const
{
  std::vector<Eigen::Vector3d> all(this->Kept.empty() ? 0 : this->Kept.back() + 1);
  for (std::size_t f = 0; f < this->Coarse.size(); ++f)
  {
    const std::size_t first = this->Coarse.offsets[f];
    const std::size_t last = this->Coarse.offsets[f + 1] - 1;
    // The growth of values from one fine control point to the next.
    const auto slope = [&](std::size_t k) -> Eigen::Vector3d
    {
      const std::size_t before = k > first ? k - 1 : k;
      const std::size_t after = k < last ? k + 1 : k;
      return (values[after] - values[before]) / static_cast<double>(this->Kept[after] - this->Kept[before]);
    };
    for (std::size_t k = first; k <= last; ++k)
    {
      all[this->Kept[k]] = values[k];
      if (k < last && this->Kept[k + 1] == this->Kept[k] + 2)
      {
        // The middle of a Hermite cubic between two, whose parameter covers two control points.
        all[this->Kept[k] + 1] = 0.5 * (values[k] + values[k + 1]) + 0.25 * (slope(k) - slope(k + 1));
      }
    }
  }
  return all;
}

std::vector<Eigen::Vector3d> CoarseFibres::refine(
  const std::vector<Eigen::Vector3d>& moved, const std::vector<Eigen::Vector3d>& fine) const
{
  std::vector<Eigen::Vector3d> displacements(moved.size());
  for (std::size_t k = 0; k < moved.size(); ++k)
  {
    displacements[k] = moved[k] - this->Coarse.points[k];
  }
  std::vector<Eigen::Vector3d> points = this->interpolate(displacements);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] += fine[i];
  }
  return points;
}

} // namespace cactus
