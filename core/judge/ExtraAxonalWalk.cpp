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

/// Joins all surfaces, which are apart from each other, into one mesh.
TriangleMesh joined(const FibreSurfaces& surfaces, const Context& context)
{
  TriangleMesh all;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    context.checkpoint();
    const TriangleMesh mesh = surfaces.mesh(i);
    const auto first = static_cast<std::int32_t>(all.points.size());
    // The tree over all of them is made last.
    requireMemory(bytesPerTriangle * static_cast<double>(all.triangles.size() + mesh.triangles.size()),
      "a walk outside the surfaces", "switch ExtraAxonalWalkers off, or cut a smaller substrate");
    if (all.points.size() + mesh.points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    {
      throw Infeasible("the surfaces have too many points for a walk outside them: switch ExtraAxonalWalkers off");
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

class Walker
{
public:
  Walker(const Outside& space, RandomEngine& engine)
    : Space(space)
    , Engine(engine)
  {
    const Domain& box = space.box();
    for (int i = 0; i < mostTries; ++i)
    {
      const double x = uniform(engine);
      const double y = uniform(engine);
      const double z = uniform(engine);
      this->Place = box.lower + box.size().cwiseProduct(Vector3d(x, y, z));
      if (space.holds(this->Place))
      {
        return;
      }
    }
    throw Infeasible(text("ExtraAxonalWalkers: of ", mostTries, " points in the domain none lay outside the fibres"));
  }

  /// Makes one step, with all reflections on its way. Returns false if they do not end.
  bool step(double length)
  {
    Vector3d direction = randomDirection(this->Engine);
    double left = length;
    for (int i = 0; i < mostReflections; ++i)
    {
      if (left <= 0.0)
      {
        return true;
      }
      Hit wall{};
      const bool isWall = this->Space.firstWall(this->Place, direction, left, wall);
      Eigen::Index axis = 0;
      const double face = this->distanceToFace(direction, axis);
      const bool isFace = face <= (isWall ? wall.distance : left);
      const double way = std::max(0.0, isFace ? face : isWall ? wall.distance - clearance : left);
      this->move(way * direction);
      left -= std::max(way, clearance);
      if (isFace)
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
        return true;
      }
    }
    return false;
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
  Vector3d Place = Vector3d::Zero();
  Vector3d Moved = Vector3d::Zero();           ///< in the space that faces mirror without end
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
  Walker walker(space, engine);
  Vector3d middle = Vector3d::Zero();
  for (std::uint64_t i = 0; i < 2 * half; ++i)
  {
    if (i == half)
    {
      middle = walker.displacement();
    }
    if (!walker.step(options.step))
    {
      return { Vector3d::Zero(), true };
    }
  }
  const Vector3d end = walker.displacement();
  return { end.cwiseProduct(end) - middle.cwiseProduct(middle), !space.holds(walker.place()) };
}

} // namespace

const PropertyList<ExtraAxonalWalkOptions>& ExtraAxonalWalkOptions::properties()
{
  using Options = ExtraAxonalWalkOptions;
  static const auto list =
    PropertyList<Options>()
      .add("ExtraAxonalWalkers", &Options::walkers, limits::walkers,
        "Random walkers outside the fibres, which show how fast diffusion is there in the long run; 0: none")
      .add("WalkDistance", &Options::distance, limits::walkDistance,
        "Root mean square of what a free walker has moved along each axis in the end: several fibre diameters")
      .whereGiven("ExtraAxonalWalkers")
      .add("WalkStep", &Options::step, limits::walkStep, "Length of a step, shorter than the pores between fibres are wide")
      .whereGiven("ExtraAxonalWalkers")
      .add("WalkSeed", &Options::seed, limits::seed, "Chooses the walks")
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
  const TriangleMesh mesh = joined(outer, context);
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

} // namespace cactus
