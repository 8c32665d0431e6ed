// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/CirclePacking.h"

#include "base/Constants.h"
#include "base/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace cactus
{

namespace
{

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

/// Square cells over a rectangle, to find the circles near a point.
struct CellGrid
{
  CellGrid(const Rectangle& bounds, double wantedCell, std::size_t circles)
    : origin(bounds.lower)
  {
    // Never many more cells than circles, however small the circles are beside the rectangle.
    const double least = std::sqrt(bounds.area() / (4.0 * static_cast<double>(circles) + 16.0));
    cell = std::max(wantedCell, least);
    for (int axis = 0; axis < 2; ++axis)
    {
      count[axis] = std::max(1, static_cast<int>(std::ceil(bounds.size()[axis] / cell)));
    }
  }
  int coordinate(double value, int axis) const
  {
    return std::clamp(static_cast<int>(std::floor((value - origin[axis]) / cell)), 0, count[axis] - 1);
  }
  std::size_t index(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(count[0]) + static_cast<std::size_t>(x);
  }
  std::size_t index(const Eigen::Vector2d& p) const { return index(coordinate(p.x(), 0), coordinate(p.y(), 1)); }
  std::size_t size() const { return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]); }
  /// Calls visit(cell index) for the cells that a square of half side `reach` around p touches, in a fixed order.
  template <typename Visit>
  void around(const Eigen::Vector2d& p, double reach, Visit&& visit) const
  {
    const int x1 = coordinate(p.x() + reach, 0);
    const int y1 = coordinate(p.y() + reach, 1);
    for (int y = coordinate(p.y() - reach, 1); y <= y1; ++y)
    {
      for (int x = coordinate(p.x() - reach, 0); x <= x1; ++x)
      {
        visit(index(x, y));
      }
    }
  }

  Eigen::Vector2d origin;
  double cell;
  std::array<int, 2> count{ { 1, 1 } };
};

/// The direction in which the circle of the lower index is pushed where two centres coincide.
Eigen::Vector2d tieBreak(std::size_t i, std::size_t j)
{
  const double angle = goldenAngle * static_cast<double>(std::min(i, j));
  const double sign = i < j ? 1.0 : -1.0;
  return sign * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

/// The moving parts of relaxCircles.
struct Relaxer
{
  Relaxer(Circles& given, const RelaxationOptions& wanted, const Context& caller)
    : circles(given)
    , options(wanted)
    , context(caller)
    , n(given.size())
    , centres(given.centres)
  {
    meanRadius = std::accumulate(circles.radii.begin(), circles.radii.end(), 0.0) / static_cast<double>(n);
    largestRadius = *std::max_element(circles.radii.begin(), circles.radii.end());
    skin = 0.4 * meanRadius;
    threads = n < serialBelow ? 1 : context.threadCount();
    blocks = (n + blockSize - 1) / blockSize;
    force.assign(n, Eigen::Vector2d::Zero());
    velocity.assign(n, Eigen::Vector2d::Zero());
    sums.resize(blocks);
    mass.resize(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      // A circle has about as many contacts as its circumference has room for; masses in proportion give all of them about the
      // same frequency, hence the same largest stable step.
      mass[i] = std::max(0.25, circles.radii[i] / meanRadius);
      centres[i] = circles.frame(i).clampCentre(centres[i], circles.radii[i]);
    }
  }

  Relaxation run()
  {
    // FIRE with its published constants; the steps are in units of the inverse frequency of one contact.
    constexpr double largestStep = 0.5;
    double step = 0.1;
    double mixing = 0.1;
    int downhill = 0;
    Relaxation result;
    buildNeighbours();
    for (;; ++result.iterations)
    {
      const Sums total = evaluate();
      result.largestOverlap = std::max(0.0, total.overlap);
      if (total.overlap <= 0.0)
      {
        result.separated = true;
        break;
      }
      const bool jammed =
        result.iterations > 50 && total.forceSquared < options.jammedBalance * options.jammedBalance * total.contactSquared;
      if (jammed || result.iterations >= options.maximumIterations)
      {
        break;
      }
      if (result.iterations % 64 == 0)
      {
        context.checkpoint();
      }
      double keep = 0.0;
      double turn = 0.0;
      if (total.power > 0.0)
      {
        keep = 1.0 - mixing;
        turn = total.forceSquared > 0.0 ? mixing * std::sqrt(total.velocitySquared / total.forceSquared) : 0.0;
        if (++downhill > 5)
        {
          step = std::min(1.1 * step, largestStep);
          mixing *= 0.99;
        }
      }
      else
      {
        downhill = 0;
        step = std::max(0.5 * step, 1e-3);
        mixing = 0.1;
      }
      move(keep, turn, step);
      if (largestTravel() > 0.5 * skin)
      {
        buildNeighbours();
      }
    }
    circles.centres = centres;
    return result;
  }

  static constexpr std::size_t blockSize = 512;
  static constexpr std::size_t serialBelow = 4096;

  struct Sums
  {
    double power = 0.0;
    double forceSquared = 0.0;
    double velocitySquared = 0.0;
    double contactSquared = 0.0;
    double overlap = -1.0;
    double travelSquared = 0.0;
  };

  template <typename Body>
  void overBlocks(Body&& body)
  {
    parallelBlocks(n, blockSize, threads, body);
  }

  /// Forces at the current centres, and the sums FIRE needs: per block in parallel, then over the blocks in order.
  Sums evaluate()
  {
    const double swell = 1.0 + options.clearance;
    overBlocks(
      [&](std::size_t block, std::size_t begin, std::size_t end)
      {
        Sums sum;
        for (std::size_t i = begin; i < end; ++i)
        {
          Eigen::Vector2d net = Eigen::Vector2d::Zero();
          for (std::size_t k = offsets[i]; k < offsets[i + 1]; ++k)
          {
            const std::size_t j = neighbours[k];
            const Eigen::Vector2d apart = centres[i] - centres[j];
            const double touching = circles.radii[i] + circles.radii[j];
            const double squared = apart.squaredNorm();
            const double reach = swell * touching;
            if (squared >= reach * reach)
            {
              continue;
            }
            const double distance = std::sqrt(squared);
            const double depth = reach - distance;
            net += distance > 0.0 ? Eigen::Vector2d((depth / distance) * apart) : Eigen::Vector2d(depth * tieBreak(i, j));
            sum.contactSquared += depth * depth;
            sum.overlap = std::max(sum.overlap, 1.0 - distance / touching);
          }
          // A wall carries what pushes a circle against it, so that is no force that could still move the circle.
          const Rectangle& frame = circles.frame(i);
          for (int axis = 0; axis < 2; ++axis)
          {
            const double r = circles.radii[i];
            if ((net[axis] < 0.0 && centres[i][axis] <= frame.lower[axis] + r) ||
                (net[axis] > 0.0 && centres[i][axis] >= frame.upper[axis] - r))
            {
              net[axis] = 0.0;
              velocity[i][axis] = 0.0;
            }
          }
          force[i] = net;
          sum.power += net.dot(velocity[i]);
          sum.forceSquared += net.squaredNorm();
          sum.velocitySquared += velocity[i].squaredNorm();
        }
        sums[block] = sum;
      });
    Sums total;
    for (const Sums& sum : sums)
    {
      total.power += sum.power;
      total.forceSquared += sum.forceSquared;
      total.velocitySquared += sum.velocitySquared;
      total.contactSquared += sum.contactSquared;
      total.overlap = std::max(total.overlap, sum.overlap);
    }
    return total;
  }

  void move(double keep, double turn, double step)
  {
    const double longest = 0.5 * meanRadius;
    overBlocks(
      [&](std::size_t block, std::size_t begin, std::size_t end)
      {
        double travelSquared = 0.0;
        for (std::size_t i = begin; i < end; ++i)
        {
          velocity[i] = keep * velocity[i] + (turn + step / mass[i]) * force[i];
          Eigen::Vector2d shift = step * velocity[i];
          const double length = shift.norm();
          if (length > longest)
          {
            shift *= longest / length;
            velocity[i] *= longest / length;
          }
          centres[i] = circles.frame(i).clampCentre(centres[i] + shift, circles.radii[i]);
          travelSquared = std::max(travelSquared, (centres[i] - listed[i]).squaredNorm());
        }
        sums[block].travelSquared = travelSquared;
      });
  }

  double largestTravel() const
  {
    double squared = 0.0;
    for (const Sums& sum : sums)
    {
      squared = std::max(squared, sum.travelSquared);
    }
    return std::sqrt(squared);
  }

  /// Lists per circle all others nearer than touching plus the skin: count, prefix sum, write.
  void buildNeighbours()
  {
    listed = centres;
    const CellGrid grid(boundingRectangle(circles.frames), 2.0 * meanRadius + skin, n);
    std::vector<std::size_t> cellStart(grid.size() + 1, 0);
    std::vector<std::size_t> cellOf(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      cellOf[i] = grid.index(centres[i]);
      ++cellStart[cellOf[i] + 1];
    }
    std::partial_sum(cellStart.begin(), cellStart.end(), cellStart.begin());
    std::vector<std::size_t> fill(cellStart.begin(), cellStart.end() - 1);
    std::vector<std::size_t> members(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      members[fill[cellOf[i]]++] = i;
    }
    const auto forNeighbours = [&](std::size_t i, auto&& use)
    {
      const double swell = 1.0 + options.clearance;
      grid.around(centres[i], swell * (circles.radii[i] + largestRadius) + skin,
        [&](std::size_t cell)
        {
          for (std::size_t k = cellStart[cell]; k < cellStart[cell + 1]; ++k)
          {
            const std::size_t j = members[k];
            const double reach = swell * (circles.radii[i] + circles.radii[j]) + skin;
            if (j != i && (centres[i] - centres[j]).squaredNorm() < reach * reach)
            {
              use(j);
            }
          }
        });
    };
    offsets.assign(n + 1, 0);
    overBlocks(
      [&](std::size_t, std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          forNeighbours(i, [&](std::size_t) { ++offsets[i + 1]; });
        }
      });
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    neighbours.resize(offsets.back());
    overBlocks(
      [&](std::size_t, std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          std::size_t next = offsets[i];
          forNeighbours(i, [&](std::size_t j) { neighbours[next++] = j; });
        }
      });
  }

  Circles& circles;
  const RelaxationOptions& options;
  const Context& context;
  std::size_t n;
  double meanRadius = 0.0;
  double largestRadius = 0.0;
  double skin = 0.0;
  int threads = 1;
  std::size_t blocks = 0;
  std::vector<Eigen::Vector2d> centres;
  std::vector<Eigen::Vector2d> listed;
  std::vector<Eigen::Vector2d> velocity;
  std::vector<Eigen::Vector2d> force;
  std::vector<double> mass;
  std::vector<Sums> sums;
  std::vector<std::size_t> offsets;
  std::vector<std::size_t> neighbours;
};

} // namespace

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

void placeCircles(Circles& circles, const CentreProposal& propose, int trials)
{
  const std::size_t n = circles.size();
  circles.centres.assign(n, Eigen::Vector2d::Zero());
  if (n == 0)
  {
    return;
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    { return circles.radii[a] != circles.radii[b] ? circles.radii[a] > circles.radii[b] : a < b; });
  const double largest = circles.radii[order.front()];
  const double mean = std::accumulate(circles.radii.begin(), circles.radii.end(), 0.0) / static_cast<double>(n);
  const CellGrid grid(boundingRectangle(circles.frames), 2.0 * mean, n);
  std::vector<std::vector<std::size_t>> cells(grid.size());

  for (const std::size_t i : order)
  {
    const double radius = circles.radii[i];
    double least = std::numeric_limits<double>::max();
    for (int trial = 0; trial < trials && least > 0.0; ++trial)
    {
      const Eigen::Vector2d centre = propose(i, trial);
      double overlap = 0.0;
      grid.around(centre, radius + largest,
        [&](std::size_t cell)
        {
          if (overlap >= least)
          {
            return;
          }
          for (const std::size_t j : cells[cell])
          {
            const double touching = radius + circles.radii[j];
            const double squared = (centre - circles.centres[j]).squaredNorm();
            if (squared < touching * touching)
            {
              const double depth = touching - std::sqrt(squared);
              overlap += depth * depth;
            }
          }
        });
      if (overlap < least)
      {
        least = overlap;
        circles.centres[i] = centre;
      }
    }
    cells[grid.index(circles.centres[i])].push_back(i);
  }
}

Relaxation relaxCircles(Circles& circles, const RelaxationOptions& options, const Context& context)
{
  if (circles.size() == 0)
  {
    Relaxation nothing;
    nothing.separated = true;
    return nothing;
  }
  return Relaxer(circles, options, context).run();
}

} // namespace cactus
