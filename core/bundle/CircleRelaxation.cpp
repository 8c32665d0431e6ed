// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/CircleRelaxation.h"

#include "base/Constants.h"
#include "base/Parallel.h"
#include "bundle/CircleGrid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace cactus
{

namespace
{

/// Returns the direction in which circle i is pushed off circle j if their centres coincide.
Eigen::Vector2d tieBreak(std::size_t i, std::size_t j)
{
  const double angle = goldenAngle * static_cast<double>(std::min(i, j));
  const double sign = i < j ? 1.0 : -1.0;
  return sign * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

/// The sums over all circles that FIRE needs.
struct Sums
{
  double power = 0.0;
  double forceSquared = 0.0;
  double velocitySquared = 0.0;
  double contactSquared = 0.0;
  double overlap = -1.0;
  double travelSquared = 0.0;
};

/// The steps of FIRE with its published constants, in units of the inverse frequency of one contact.
struct Fire
{
  double keep = 0.0; ///< fraction of the velocity that is kept
  double turn = 0.0; ///< fraction of the force that is added to it, besides the step
  double step = 0.1;

  /// Chooses the next step: longer as long as the energy falls, else short and from rest.
  void adapt(const Sums& total)
  {
    constexpr double largestStep = 0.5;
    this->keep = 0.0;
    this->turn = 0.0;
    if (total.power > 0.0)
    {
      this->keep = 1.0 - this->Mixing;
      this->turn = total.forceSquared > 0.0 ? this->Mixing * std::sqrt(total.velocitySquared / total.forceSquared) : 0.0;
      if (++this->Downhill > 5)
      {
        this->step = std::min(1.1 * this->step, largestStep);
        this->Mixing *= 0.99;
      }
    }
    else
    {
      this->Downhill = 0;
      this->step = std::max(0.5 * this->step, 1e-3);
      this->Mixing = 0.1;
    }
  }

private:
  double Mixing = 0.1;
  int Downhill = 0;
};

/// The state of relaxCircles().
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
      // A circle has about as many contacts as its circumference has room for. Masses in this proportion give all circles about
      // the same frequency, hence the same largest stable step.
      mass[i] = std::max(0.25, circles.radii[i] / meanRadius);
      centres[i] = circles.frame(i).clampCentre(centres[i], circles.radii[i]);
    }
  }

  Relaxation run()
  {
    Relaxation result;
    Fire fire;
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
      fire.adapt(total);
      move(fire);
      if (largestTravel() > 0.5 * skin)
      {
        buildNeighbours();
      }
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      circles.centres[i] = circles.frame(i).inside(centres[i]);
    }
    return result;
  }

  static constexpr std::size_t blockSize = 512;
  static constexpr std::size_t serialBelow = 4096;

  template <typename Body>
  void overBlocks(Body&& body)
  {
    parallelBlocks(n, blockSize, threads, body);
  }

  /// Computes the forces at the current centres and FIRE's sums: per block in parallel, then over the blocks in order.
  Sums evaluate()
  {
    overBlocks(
      [&](std::size_t block, std::size_t begin, std::size_t end)
      {
        Sums sum;
        for (std::size_t i = begin; i < end; ++i)
        {
          force[i] = contactForce(i, sum);
          restOnWalls(i);
          sum.power += force[i].dot(velocity[i]);
          sum.forceSquared += force[i].squaredNorm();
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

  /// Returns the force of all neighbours on circle i, and adds it to the sums.
  Eigen::Vector2d contactForce(std::size_t i, Sums& sum) const
  {
    const double swell = 1.0 + options.clearance;
    Eigen::Vector2d net = Eigen::Vector2d::Zero();
    for (std::size_t k = offsets[i]; k < offsets[i + 1]; ++k)
    {
      const std::size_t j = neighbours[k];
      const Eigen::Vector2d apart = circles.frame(i).shortest(centres[i] - centres[j]);
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
    return net;
  }

  /// Removes the force that pushes a circle against a wall: the wall carries it.
  void restOnWalls(std::size_t i)
  {
    const Rectangle& frame = circles.frame(i);
    const double r = circles.radii[i];
    for (int axis = 0; axis < 2 && !frame.repeats; ++axis)
    {
      if ((force[i][axis] < 0.0 && centres[i][axis] <= frame.lower[axis] + r) ||
          (force[i][axis] > 0.0 && centres[i][axis] >= frame.upper[axis] - r))
      {
        force[i][axis] = 0.0;
        velocity[i][axis] = 0.0;
      }
    }
  }

  void move(const Fire& fire)
  {
    const double longest = 0.5 * meanRadius;
    overBlocks(
      [&](std::size_t block, std::size_t begin, std::size_t end)
      {
        double travelSquared = 0.0;
        for (std::size_t i = begin; i < end; ++i)
        {
          velocity[i] = fire.keep * velocity[i] + (fire.turn + fire.step / mass[i]) * force[i];
          Eigen::Vector2d shift = fire.step * velocity[i];
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

  /// The circles in each cell of a grid: a counting sort.
  struct Members
  {
    Members(const CircleGrid& grid, const Circles& all, const std::vector<Eigen::Vector2d>& centres)
      : start(grid.size() + 1, 0)
      , circles(centres.size())
    {
      std::vector<std::size_t> cellOf(centres.size());
      for (std::size_t i = 0; i < centres.size(); ++i)
      {
        cellOf[i] = grid.index(all.frame(i).inside(centres[i]));
        ++start[cellOf[i] + 1];
      }
      std::partial_sum(start.begin(), start.end(), start.begin());
      std::vector<std::size_t> fill(start.begin(), start.end() - 1);
      for (std::size_t i = 0; i < centres.size(); ++i)
      {
        circles[fill[cellOf[i]]++] = i;
      }
    }

    std::vector<std::size_t> start; ///< start of each cell, in circles
    std::vector<std::size_t> circles;
  };

  /// Calls use(j) for all circles nearer to circle i than touching plus the skin.
  template <typename Use>
  void forNeighbours(const CircleGrid& grid, const Members& members, std::size_t i, Use&& use) const
  {
    const double swell = 1.0 + options.clearance;
    const Rectangle& frame = circles.frame(i);
    const Eigen::Vector2d centre = frame.inside(centres[i]);
    const auto lookAround = [&](const Eigen::Vector2d& place)
    {
      grid.around(place, swell * (circles.radii[i] + largestRadius) + skin,
        [&](std::size_t cell)
        {
          for (std::size_t k = members.start[cell]; k < members.start[cell + 1]; ++k)
          {
            const std::size_t j = members.circles[k];
            const double reach = swell * (circles.radii[i] + circles.radii[j]) + skin;
            if (j != i && (place - frame.inside(centres[j])).squaredNorm() < reach * reach)
            {
              use(j);
            }
          }
        });
    };
    lookAround(centre);
    for (int image = 0; frame.repeats && image < 9; ++image)
    {
      const Eigen::Vector2d shift(image % 3 - 1, image / 3 - 1); // NOLINT(bugprone-integer-division): row and column
      if (image != 4)
      {
        lookAround(centre + shift.cwiseProduct(frame.size()));
      }
    }
  }

  /// Lists the neighbours of all circles: count, prefix sum, write.
  void buildNeighbours()
  {
    listed = centres;
    const CircleGrid grid(boundingRectangle(circles.frames), 2.0 * meanRadius + skin, n);
    const Members members(grid, circles, centres);
    offsets.assign(n + 1, 0);
    parallelForInBlocks(
      n, blockSize, threads, [&](std::size_t i) { forNeighbours(grid, members, i, [&](std::size_t) { ++offsets[i + 1]; }); });
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    neighbours.resize(offsets.back());
    parallelForInBlocks(n, blockSize, threads,
      [&](std::size_t i)
      {
        std::size_t next = offsets[i];
        forNeighbours(grid, members, i, [&](std::size_t j) { neighbours[next++] = j; });
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

Relaxation relaxCircles(Circles& circles, const RelaxationOptions& options, const Context& context)
{
  if (circles.size() == 0)
  {
    Relaxation none;
    none.separated = true;
    return none;
  }
  return Relaxer(circles, options, context).run();
}

} // namespace cactus
