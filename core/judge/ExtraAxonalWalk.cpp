// SPDX-License-Identifier: BSD-3-Clause
#include "judge/ExtraAxonalWalk.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "base/Random.h"
#include "mesh/SurfaceSide.h"
#include "mesh/TriangleTree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Distance (µm) that a walker keeps from the wall that has reflected it: far above rounding, far below any gap.
constexpr double clearance = 1e-7;
/// Reflections in a step, after which a walker is given up: it has no room, for example between a cap and a face.
constexpr int mostReflections = 1000;
/// Steps of one walker: half a minute, after which a run can be stopped.
constexpr double mostSteps = 2e7;
/// Points in the domain that are tried as the start of one walker.
constexpr int mostTries = 5000;
constexpr double bytesPerTriangle = 150.0;

/// All surfaces as one, which are apart from each other. `advice` is what to do where there is no memory for them.
TriangleMesh joined(const FibreSurfaces& surfaces, const std::string& advice, const Context& context)
{
  TriangleMesh all;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    context.checkpoint();
    const TriangleMesh mesh = surfaces.mesh(i);
    const auto first = static_cast<std::int32_t>(all.points.size());
    // The tree over all of them is made last.
    requireMemory(bytesPerTriangle * static_cast<double>(all.triangles.size() + mesh.triangles.size()),
      "a walk outside the surfaces", advice);
    if (all.points.size() + mesh.points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    {
      throw OutOfMemory("the surfaces have too many points for a walk outside them: " + advice);
    }
    all.points.insert(all.points.end(), mesh.points.begin(), mesh.points.end());
    for (const auto& triangle : mesh.triangles)
    {
      all.triangles.push_back({ triangle[0] + first, triangle[1] + first, triangle[2] + first });
    }
  }
  return all;
}

/// The hit of a path on a wall: its distance along the path, and the wall's normal.
struct Hit
{
  double distance;
  Vector3d normal;
};

/// The space outside the fibres.
class Outside
{
public:
  Outside(const Domain& domain, const TriangleTree& walls)
    : Box(domain)
    , Walls(walls)
  {
  }

  bool holds(const Vector3d& point) const { return sideOf(this->Walls, point) == Side::Outside; }

  /// Finds the first wall within `length` µm.
  bool firstWall(const Vector3d& from, const Vector3d& direction, double length, Hit& hit) const
  {
    const Vector3d to = from + length * direction;
    const FloatBox way = FloatBox::around(from, to, to);
    hit.distance = length;
    bool found = false;
    visitEntries(
      this->Walls, [&](const FloatBox& box) { return box.overlaps(way); },
      [&](std::uint32_t triangle)
      {
        found = this->meets(triangle, from, direction, hit) || found;
        return false;
      });
    return found;
  }

  const Domain& box() const { return this->Box; }

private:
  /// Tests a triangle (Möller and Trumbore 1997). A nearer hit replaces the previous one.
  bool meets(std::uint32_t triangle, const Vector3d& from, const Vector3d& direction, Hit& hit) const
  {
    const Vector3d& corner = this->Walls.corner(triangle, 0);
    const Vector3d edge1 = this->Walls.corner(triangle, 1) - corner;
    const Vector3d edge2 = this->Walls.corner(triangle, 2) - corner;
    const Vector3d across = direction.cross(edge2);
    const double determinant = edge1.dot(across);
    if (determinant == 0.0)
    {
      return false; // along the wall
    }
    const Vector3d offset = from - corner;
    const double u = offset.dot(across) / determinant;
    const Vector3d turned = offset.cross(edge1);
    const double v = direction.dot(turned) / determinant;
    const double distance = edge2.dot(turned) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || distance < 0.0 || distance >= hit.distance)
    {
      return false;
    }
    hit = { distance, edge1.cross(edge2).normalized() };
    return true;
  }

  const Domain& Box;
  const TriangleTree& Walls;
};

Vector3d randomDirection(RandomEngine& engine)
{
  const double z = 2.0 * uniform(engine) - 1.0;
  const double angle = 2.0 * pi * uniform(engine);
  const double radius = std::sqrt(1.0 - z * z);
  return { radius * std::cos(angle), radius * std::sin(angle), z };
}

/// What the domain's faces do to walkers; through periodic ones they come in again on the other side.
enum class Faces
{
  Mirror,
  LetOut
};

/// How a step ends.
enum class StepEnd
{
  Inside,
  AtFace,
  Lost ///< among reflections without end
};

class Walker
{
public:
  Walker(const Outside& space, RandomEngine& engine, Faces faces)
    : Space(space)
    , Engine(engine)
    , AtFaces(faces)
  {
  }

  /// Puts the walker anywhere outside the fibres in a box. False where no such place was found.
  bool startIn(const Domain& box)
  {
    for (int i = 0; i < mostTries; ++i)
    {
      const double x = uniform(this->Engine);
      const double y = uniform(this->Engine);
      const double z = uniform(this->Engine);
      this->Place = box.lower + box.size().cwiseProduct(Vector3d(x, y, z));
      if (this->Space.holds(this->Place))
      {
        return true;
      }
    }
    return false;
  }

  /// One step, with all reflections on its way, or its part up to a face that lets the walker out.
  StepEnd step(double length)
  {
    Vector3d direction = randomDirection(this->Engine);
    double left = length;
    for (int i = 0; i < mostReflections; ++i)
    {
      if (left <= 0.0)
      {
        return StepEnd::Inside;
      }
      Hit wall{};
      const bool isWall = this->Space.firstWall(this->Place, direction, left, wall);
      Eigen::Index axis = 0;
      const double face = this->distanceToFace(direction, axis);
      const bool isFace = face <= (isWall ? wall.distance : left);
      const double way = std::max(0.0, isFace ? face : isWall ? wall.distance - clearance : left);
      this->move(way * direction);
      left -= std::max(way, clearance);
      if (isFace && this->Space.box().periodic[static_cast<std::size_t>(axis)])
      {
        // Walls end at the same places there, so that it comes out between them.
        this->Place[axis] = direction[axis] > 0.0 ? this->Space.box().lower[axis] : this->Space.box().upper[axis];
      }
      else if (isFace && this->AtFaces == Faces::LetOut)
      {
        return StepEnd::AtFace;
      }
      else if (isFace)
      {
        direction[axis] = -direction[axis];
        this->Mirrored[axis] = -this->Mirrored[axis];
      }
      else if (isWall)
      {
        direction -= 2.0 * direction.dot(wall.normal) * wall.normal;
      }
      else
      {
        return StepEnd::Inside;
      }
    }
    return StepEnd::Lost;
  }

  const Vector3d& place() const { return this->Place; }
  const Vector3d& displacement() const { return this->Moved; }

private:
  double distanceToFace(const Vector3d& direction, Eigen::Index& axis) const
  {
    const Domain& box = this->Space.box();
    double nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < 3; ++i)
    {
      const double room = direction[i] > 0.0 ? box.upper[i] - this->Place[i] : this->Place[i] - box.lower[i];
      const double distance = direction[i] != 0.0 ? room / std::abs(direction[i]) : std::numeric_limits<double>::infinity();
      if (distance < nearest)
      {
        nearest = distance;
        axis = i;
      }
    }
    return std::max(0.0, nearest);
  }

  void move(const Vector3d& way)
  {
    this->Place += way;
    this->Moved += this->Mirrored.cwiseProduct(way);
  }

  const Outside& Space;
  RandomEngine& Engine;
  Faces AtFaces;
  Vector3d Place = Vector3d::Zero();
  Vector3d Moved = Vector3d::Zero();           ///< in the space that faces mirror or repeat without end
  Vector3d Mirrored = Vector3d::Constant(1.0); ///< −1 along axes that are mirrored at the walker
};

/// The result of one walk: the growth of the squared displacement over its second half.
struct Walk
{
  Vector3d growth = Vector3d::Zero(); ///< µm²
  bool hasLeaked = false;
};

Walk walk(const Outside& space, const ExtraAxonalWalkOptions& options, std::uint64_t number, std::uint64_t half)
{
  RandomEngine engine = randomStream(options.seed, RandomStage::ExtraAxonalWalk, number);
  Walker walker(space, engine, Faces::Mirror);
  if (!walker.startIn(space.box()))
  {
    throw Infeasible(text("ExtraAxonalWalkers: of ", mostTries, " points in the domain none lay outside the fibres"));
  }
  Vector3d middle = Vector3d::Zero();
  for (std::uint64_t i = 0; i < 2 * half; ++i)
  {
    if (i == half)
    {
      middle = walker.displacement();
    }
    if (walker.step(options.step) == StepEnd::Lost)
    {
      return { Vector3d::Zero(), true };
    }
  }
  const Vector3d end = walker.displacement();
  return { end.cwiseProduct(end) - middle.cwiseProduct(middle), !space.holds(walker.place()) };
}

/// How a walk until leaving is taken.
struct LeavingWalk
{
  Domain start;
  double step;         ///< µm
  std::uint64_t steps; ///< at most
  std::uint64_t seed;
};

/// What free walkers have moved (µm, see LeavingWalkers) when the walker leaves; infinity where it stays, and NaN where it has
/// leaked or there was no room to start.
double leavingDistance(const Outside& space, const LeavingWalk& order, std::uint64_t number)
{
  RandomEngine engine = randomStream(order.seed, RandomStage::ExtraAxonalWalk, number);
  Walker walker(space, engine, Faces::LetOut);
  if (!walker.startIn(order.start))
  {
    return notANumber;
  }
  for (std::uint64_t i = 1; i <= order.steps; ++i)
  {
    const StepEnd end = walker.step(order.step);
    if (end == StepEnd::AtFace)
    {
      return order.step * std::sqrt(static_cast<double>(i) / 3.0);
    }
    if (end == StepEnd::Lost)
    {
      return notANumber;
    }
  }
  return space.holds(walker.place()) ? std::numeric_limits<double>::infinity() : notANumber;
}

/// The part of free walkers, starting evenly between `lower` and `upper` within [0, 1], that has not left [0, 1] when they have
/// moved by `distance` (root mean square): the series of the absorbing slab (Carslaw & Jaeger 1959, section 3.3).
double freeStay(double lower, double upper, double distance)
{
  constexpr int mostTerms = 20000;
  double stay = 0.0;
  for (int term = 0; term < mostTerms; ++term)
  {
    const double n = pi * (2.0 * term + 1.0);
    const double decay = std::exp(-0.5 * n * n * distance * distance);
    if (decay == 0.0)
    {
      break;
    }
    const double mean = upper > lower ? (std::cos(n * lower) - std::cos(n * upper)) / (n * (upper - lower)) : std::sin(n * lower);
    stay += 4.0 / n * decay * mean;
  }
  return std::clamp(stay, 0.0, 1.0);
}

} // namespace

const PropertyList<ExtraAxonalWalkOptions>& ExtraAxonalWalkOptions::properties()
{
  using Options = ExtraAxonalWalkOptions;
  static const auto list =
    PropertyList<Options>()
      .add("ExtraAxonalWalkers", &Options::walkers, limits::walkers,
        "Number of random walkers outside the fibres. They measure the long-time diffusivity of water there along x, y and z, "
        "over that without fibres (the tortuosity limit). 1000 walkers give it to a few per cent, and take most of the time. 0: "
        "none.")
      .add("WalkDistance", &Options::distance, limits::walkDistance,
        "Distance in µm that a walker would cover along each axis without fibres (root mean square). Use several fibre "
        "diameters. Twice the distance is four times the work.")
      .whereGiven("ExtraAxonalWalkers")
      .add("WalkStep", &Options::step, limits::walkStep,
        "Length of a walker's step in µm. It should be smaller than the width of the pores between fibres. Half the length is "
        "four times the work.")
      .whereGiven("ExtraAxonalWalkers")
      .add("WalkSeed", &Options::seed, limits::seed, "Seed of the walks. The same seed gives the same walks.")
      .whereGiven("ExtraAxonalWalkers");
  return list;
}

ExtraAxonalDiffusion walkOutside(
  const Domain& domain, const FibreSurfaces& outer, const ExtraAxonalWalkOptions& options, const Context& context)
{
  validateProperties(options);
  ExtraAxonalDiffusion result;
  if (options.walkers == 0)
  {
    return result;
  }
  const double steps = 3.0 * std::pow(options.distance / options.step, 2);
  if (steps > mostSteps)
  {
    throw InvalidInput(text("WalkStep ", options.step, " µm makes walks of ", steps, " steps over WalkDistance ",
      options.distance, " µm, and ", mostSteps, " is the most: lengthen the one or shorten the other"));
  }
  const TriangleMesh mesh = joined(outer, "switch ExtraAxonalWalkers off, or cut a smaller substrate", context);
  const TriangleTree tree(mesh);
  const Outside space(domain, tree);
  const auto half = static_cast<std::uint64_t>(std::ceil(0.5 * steps));
  std::vector<Walk> walks(static_cast<std::size_t>(options.walkers));
  parallelFor(
    walks.size(), context, [&](std::size_t i) { walks[i] = walk(space, options, i, half); }, "Walking outside");

  Vector3d sum = Vector3d::Zero();
  Vector3d squares = Vector3d::Zero();
  for (const Walk& one : walks)
  {
    result.leaked += one.hasLeaked ? 1 : 0;
    sum += one.hasLeaked ? Vector3d::Zero().eval() : one.growth;
    squares += one.hasLeaked ? Vector3d::Zero().eval() : one.growth.cwiseProduct(one.growth).eval();
  }
  if (100 * result.leaked > walks.size())
  {
    throw Infeasible(text("ExtraAxonalWalkers: ", result.leaked, " of ", walks.size(),
      " walkers came to be inside a fibre: the surfaces meet, or are not closed; look at their certificate"));
  }
  const double count = static_cast<double>(walks.size() - result.leaked);
  const double free = static_cast<double>(half) * options.step * options.step / 3.0;
  const Vector3d mean = sum / count;
  result.ratio = mean / free;
  result.standardError = ((squares / count - mean.cwiseProduct(mean)) / count).cwiseSqrt() / free;
  return result;
}

double freeLeavingShare(const Domain& domain, const Domain& start, double distance)
{
  double stay = 1.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    const double side = domain.size()[axis];
    stay *= domain.periodic[static_cast<std::size_t>(axis)] ? 1.0
                                                            : freeStay((start.lower[axis] - domain.lower[axis]) / side,
                                                                (start.upper[axis] - domain.lower[axis]) / side, distance / side);
  }
  return 1.0 - stay;
}

LeavingWalkers walkUntilLeaving(const Domain& domain, const Domain& start, const FibreSurfaces& outer, double distance,
  std::uint64_t seed, const Context& context)
{
  constexpr std::size_t walkers = 1000;
  constexpr std::size_t first = 200;
  constexpr std::size_t many = 30;
  constexpr double longestStep = 0.5;
  const double side = domain.size().minCoeff();
  LeavingWalk order{ start, std::min(longestStep, std::max(side / 25.0, distance / 50.0)), 0, seed };
  // A walker in steps that are even between -1 and 1 along an axis meets a face 0.298 of one later than a continuous one does
  // (Comtet & Majumdar 2005, J Stat Mech P06013).
  constexpr double late = 0.29795;
  Domain box = domain;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    const double inwards = domain.periodic[static_cast<std::size_t>(axis)] ? 0.0 : late * order.step;
    box.lower[axis] += inwards;
    box.upper[axis] -= inwards;
  }
  const TriangleMesh mesh = joined(outer, "cut a smaller substrate", context);
  const TriangleTree tree(mesh);
  const Outside space(box, tree);
  LeavingWalkers found;
  RandomEngine engine = randomStream(seed, RandomStage::ExtraAxonalWalk);
  if (!Walker(space, engine, Faces::LetOut).startIn(start))
  {
    return found; // and a thousand of them would look long
  }
  const auto walkOut = [&](std::size_t from, std::size_t to)
  {
    order.steps = static_cast<std::uint64_t>(std::ceil(3.0 * std::pow(found.until / order.step, 2) - 1e-6));
    std::vector<double> distances(to - from);
    parallelFor(
      distances.size(), context, [&](std::size_t i) { distances[i] = leavingDistance(space, order, from + i); }, "Walking out");
    found.early +=
      static_cast<std::size_t>(std::count_if(distances.begin(), distances.end(), [](double one) { return !std::isnan(one); }));
    std::copy_if(
      distances.begin(), distances.end(), std::back_inserter(found.distances), [](double one) { return std::isfinite(one); });
    std::sort(found.distances.begin(), found.distances.end());
  };
  const auto count = [&]
  {
    found.walkers = found.early;
    found.leaving = found.distances.size();
  };
  found.until = distance;
  walkOut(0, first);
  count();
  if (found.leaving <= many)
  {
    walkOut(first, walkers);
    count();
    return found;
  }
  found.until = found.distances[many];
  found.distances.resize(many + 1);
  walkOut(first, walkers);
  return found;
}

} // namespace cactus
