// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/CirclePlacement.h"

#include "bundle/CircleGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace cactus
{

namespace
{

/// The circles placed so far.
class Placed
{
public:
  explicit Placed(Circles& circles)
    : All(circles)
    , Largest(*std::max_element(circles.radii.begin(), circles.radii.end()))
    , Grid(boundingRectangle(circles.frames),
        2.0 * std::accumulate(circles.radii.begin(), circles.radii.end(), 0.0) / static_cast<double>(circles.size()),
        circles.size())
    , Cells(this->Grid.size())
  {
  }

  void add(std::size_t circle) { this->Cells[this->Grid.index(this->All.centres[circle])].push_back(circle); }

  /// Returns the sum of the squared depths by which a circle would overlap the others; above `enough`, any sum above it.
  double overlap(const Eigen::Vector2d& centre, double radius, double enough) const
  {
    double sum = 0.0;
    this->Grid.around(centre, radius + this->Largest,
      [&](std::size_t cell)
      {
        if (sum >= enough)
        {
          return;
        }
        for (const std::size_t j : this->Cells[cell])
        {
          const double touching = radius + this->All.radii[j];
          const double squared = (centre - this->All.centres[j]).squaredNorm();
          if (squared < touching * touching)
          {
            const double depth = touching - std::sqrt(squared);
            sum += depth * depth;
          }
        }
      });
    return sum;
  }

private:
  const Circles& All;
  double Largest;
  CircleGrid Grid;
  std::vector<std::vector<std::size_t>> Cells;
};

} // namespace

std::vector<std::size_t> largestFirst(const std::vector<double>& radii)
{
  std::vector<std::size_t> order(radii.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return radii[a] != radii[b] ? radii[a] > radii[b] : a < b; });
  return order;
}

void placeCircles(Circles& circles, const CentreProposal& propose, int trials)
{
  circles.centres.assign(circles.size(), Eigen::Vector2d::Zero());
  if (circles.size() == 0)
  {
    return;
  }
  Placed placed(circles);
  for (const std::size_t i : largestFirst(circles.radii))
  {
    double least = std::numeric_limits<double>::max();
    for (int trial = 0; trial < trials && least > 0.0; ++trial)
    {
      const Eigen::Vector2d centre = propose(i, trial);
      const double overlap = placed.overlap(centre, circles.radii[i], least);
      if (overlap < least)
      {
        least = overlap;
        circles.centres[i] = centre;
      }
    }
    placed.add(i);
  }
}

} // namespace cactus
