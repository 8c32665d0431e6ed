// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceSpacing.h"

#include "base/Parallel.h"
#include "mesh/CappedSurface.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/TriangleTree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// µm that a pair is moved farther apart than it has to be: rounding, and corners that move askew, take some of it back.
constexpr double extraDistance = 0.0002;
/// Surfaces that meet are moved as if they had to keep this distance (µm), or the gap if that is larger: they have to get out of
/// each other first.
constexpr double distanceAfterMeeting = 0.005;
/// µm that a distance may lose where points are written in single precision; extraDistance is more.
constexpr double rounding = 5e-5;
/// Most pairs take one or two; corners whose normals point askew, as on a face that cuts a fibre at a small angle, get apart
/// slowly.
constexpr int rounds = 48;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Surfaces are looked at in slabs along z, of this thickness (µm), so that trees are held over one slab at a time.
constexpr double slabThickness = 10.0;

/// The slabs of a box, each with what is as near to it as the gap: where two surfaces are too near, both are in the slab that the
/// place is in.
struct Slabs
{
  Slabs(const Eigen::AlignedBox3d& box, double gap)
    : first(box.min()[2])
    , gap(gap)
    , count(std::max(1, static_cast<int>(std::ceil(box.sizes()[2] / slabThickness))))
  {
  }

  double lower(int slab) const { return slab == 0 ? -infinite : this->first + slab * slabThickness - this->gap; }
  double upper(int slab) const
  {
    return slab == this->count - 1 ? infinite : this->first + (slab + 1) * slabThickness + this->gap;
  }
  /// The slab of a height, which may be beside the box.
  int at(double z) const
  {
    return static_cast<int>(std::clamp(std::floor((z - this->first) / slabThickness), 0.0, this->count - 1.0));
  }

  double first;
  double gap;
  int count;
};

/// The boxes of what of a surface is in each slab, from the first slab that it is in.
struct SlabBoxes
{
  int first = 0;
  std::vector<Eigen::AlignedBox3d> boxes;

  /// Null where nothing of it is.
  const Eigen::AlignedBox3d* in(int slab) const
  {
    const bool isHeld = slab >= this->first && slab - this->first < static_cast<int>(this->boxes.size());
    const Eigen::AlignedBox3d* box = isHeld ? &this->boxes[std::size_t(slab - this->first)] : nullptr;
    return box != nullptr && !box->isEmpty() ? box : nullptr;
  }
};

/// What of a surface is in a slab, as a mesh of its own.
struct Part
{
  TriangleMesh mesh;
  std::vector<std::int32_t> pointOf; ///< the surface's points that are the mesh's
  std::unique_ptr<TriangleTree> tree;
};

/// Two surfaces whose parts are near each other, and by which triangles they are too near.
struct Pair
{
  std::size_t one;
  std::size_t other;
  double missing = 0.0; ///< µm, of the gap
  std::vector<std::uint32_t> trianglesOfOne;
  std::vector<std::uint32_t> trianglesOfOther;
};

/// Which pairs of surfaces are looked at.
struct PairSelection
{
  std::vector<char> isGiven;   ///< by the caller, or moved
  std::vector<char> isChanged; ///< since all were looked at

  bool holds(std::size_t a, std::size_t b) const
  {
    return (this->isGiven[a] || this->isGiven[b]) && (this->isChanged[a] || this->isChanged[b]);
  }
};

/// How far to move each of the points that have to move.
using Moves = std::map<std::int32_t, double>;

void moveInwards(TriangleMesh& mesh, const Moves& moves, const Eigen::AlignedBox3d& box, double margin)
{
  const auto onFace = [&](std::int32_t p, Eigen::Index axis, int side)
  { return mesh.points[std::size_t(p)][axis] == (side == 0 ? box.min()[axis] : box.max()[axis]); };
  std::map<std::int32_t, Vector3d> normals;
  for (const auto& t : mesh.triangles)
  {
    if (moves.count(t[0]) == 0 && moves.count(t[1]) == 0 && moves.count(t[2]) == 0)
    {
      continue;
    }
    bool isCap = false;
    for (int face = 0; face < 6; ++face)
    {
      const Eigen::Index axis = face / 2;
      isCap = isCap || (onFace(t[0], axis, face % 2) && onFace(t[1], axis, face % 2) && onFace(t[2], axis, face % 2));
    }
    if (isCap)
    {
      continue;
    }
    const Vector3d& a = mesh.points[std::size_t(t[0])];
    const Vector3d normal = (mesh.points[std::size_t(t[1])] - a).cross(mesh.points[std::size_t(t[2])] - a);
    for (const std::int32_t corner : t)
    {
      normals.emplace(corner, Vector3d::Zero()).first->second += normal;
    }
  }
  for (const auto& [point, distance] : moves)
  {
    const auto found = normals.find(point);
    if (found == normals.end())
    {
      continue; // amid a cap
    }
    Vector3d normal = found->second;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      if (onFace(point, axis, 0) || onFace(point, axis, 1))
      {
        normal[axis] = 0.0;
      }
    }
    const double length = normal.norm();
    if (length > 0.0)
    {
      Vector3d& p = mesh.points[std::size_t(point)];
      p = keptInside(box, p, p - (distance / length) * normal, margin);
    }
  }
}

void addMoves(Moves& moves, const Part& part, const std::vector<std::uint32_t>& triangles, double distance)
{
  for (const std::uint32_t t : triangles)
  {
    for (const std::int32_t corner : part.mesh.triangles[t])
    {
      double& move = moves.emplace(part.pointOf[std::size_t(corner)], 0.0).first->second;
      move = std::max(move, distance);
    }
  }
}

SlabBoxes boxesBySlab(const TriangleMesh& mesh, const Slabs& slabs)
{
  SlabBoxes result;
  if (mesh.points.empty())
  {
    return result;
  }
  const auto byHeight = [](const Vector3d& a, const Vector3d& b) { return a[2] < b[2]; };
  const auto [lowest, highest] = std::minmax_element(mesh.points.begin(), mesh.points.end(), byHeight);
  // One slab more on either side: rounding, and the gap.
  result.first = std::max(0, slabs.at((*lowest)[2] - slabs.gap) - 1);
  result.boxes.resize(std::size_t(std::min(slabs.count - 1, slabs.at((*highest)[2] + slabs.gap) + 1) - result.first + 1));
  for (const auto& t : mesh.triangles)
  {
    Eigen::AlignedBox3d triangle;
    for (const std::int32_t corner : t)
    {
      triangle.extend(mesh.points[std::size_t(corner)]);
    }
    const int last = std::min(slabs.count - 1, slabs.at(triangle.max()[2] + slabs.gap) + 1);
    for (int slab = std::max(0, slabs.at(triangle.min()[2] - slabs.gap) - 1); slab <= last; ++slab)
    {
      if (triangle.max()[2] >= slabs.lower(slab) && triangle.min()[2] <= slabs.upper(slab))
      {
        result.boxes[std::size_t(slab - result.first)].extend(triangle);
      }
    }
  }
  return result;
}

/// Fills in what of a surface touches `lower` <= z <= `upper`.
void cutOut(const TriangleMesh& mesh, double lower, double upper, Part& part)
{
  std::vector<unsigned char> beyond(mesh.points.size());
  for (std::size_t p = 0; p < beyond.size(); ++p)
  {
    const double z = mesh.points[p][2];
    beyond[p] = static_cast<unsigned char>((z < lower ? 1 : 0) + (z > upper ? 2 : 0));
  }
  constexpr std::int32_t none = -1;
  std::vector<std::int32_t> placeOf(mesh.points.size(), none);
  for (const auto& t : mesh.triangles)
  {
    if ((beyond[std::size_t(t[0])] & beyond[std::size_t(t[1])] & beyond[std::size_t(t[2])]) != 0)
    {
      continue;
    }
    std::array<std::int32_t, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
    {
      std::int32_t& place = placeOf[std::size_t(t[i])];
      if (place == none)
      {
        place = static_cast<std::int32_t>(part.pointOf.size());
        part.pointOf.push_back(t[i]);
        part.mesh.points.push_back(mesh.points[std::size_t(t[i])]);
      }
      corners[i] = place;
    }
    part.mesh.triangles.push_back(corners);
  }
  part.tree = std::make_unique<TriangleTree>(part.mesh);
}

void measureGap(Pair& pair, const TriangleTree& one, const TriangleTree& other, double gap)
{
  const SurfaceGap nearest = smallestGap(one, other, gap);
  if (nearest.found())
  {
    const double wanted = nearest.distance == 0.0 ? std::max(gap, distanceAfterMeeting) : gap;
    pair.missing = wanted - nearest.distance;
    pair.trianglesOfOne = trianglesNear(one, other, wanted);
    pair.trianglesOfOther = trianglesNear(other, one, wanted);
  }
}

std::string bytesOf(const SlabBoxes& slabs)
{
  ByteWriter put;
  put(slabs.first);
  for (const Eigen::AlignedBox3d& box : slabs.boxes)
  {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      put(box.min()[axis]);
      put(box.max()[axis]);
    }
  }
  return put.bytes();
}

SlabBoxes boxesFrom(const std::string& bytes)
{
  ByteReader get(bytes);
  SlabBoxes slabs;
  get(slabs.first);
  while (!get.isAtEnd())
  {
    Eigen::AlignedBox3d& box = slabs.boxes.emplace_back();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      get(box.min()[axis]);
      get(box.max()[axis]);
    }
  }
  return slabs;
}

std::string bytesOf(const std::map<std::size_t, Moves>& moves)
{
  ByteWriter put;
  for (const auto& [surface, ofSurface] : moves)
  {
    put(static_cast<std::uint64_t>(surface));
    put(static_cast<std::uint64_t>(ofSurface.size()));
    for (const auto& [point, distance] : ofSurface)
    {
      put(point);
      put(distance);
    }
  }
  return put.bytes();
}

/// What all processes have found: of several distances for a point the largest, as in one process.
std::map<std::size_t, Moves> joined(const std::vector<std::string>& all)
{
  std::map<std::size_t, Moves> moves;
  for (const std::string& bytes : all)
  {
    for (ByteReader get(bytes); !get.isAtEnd();)
    {
      Moves& ofSurface = moves[std::size_t(get.get<std::uint64_t>())];
      for (auto count = get.get<std::uint64_t>(); count > 0; --count)
      {
        double& move = ofSurface.emplace(get.get<std::int32_t>(), 0.0).first->second;
        move = std::max(move, get.get<double>());
      }
    }
  }
  return moves;
}

/// Looks slab by slab for what is too near, and moves it.
class Spacing
{
public:
  Spacing(SurfaceStore& surfaces, double gap, const Eigen::AlignedBox3d& box, const Context& context, const Sharing& sharing)
    : Surfaces(surfaces)
    , Gap(gap)
    , Box(box)
    , Caller(context)
    , Shared(sharing)
    , InSlabs(box, gap)
    , Boxes(surfaces.size())
  {
    this->Shared.loop(
      surfaces.size(), context, [this](std::size_t s) { this->Boxes[s] = boxesBySlab(*this->Surfaces.get(s), this->InSlabs); },
      [this](std::size_t s) { return bytesOf(this->Boxes[s]); },
      [this](std::size_t s, const std::string& bytes) { this->Boxes[s] = boxesFrom(bytes); });
  }

  /// How far points of surfaces have to move. `report(part)` gets how much of the work is done.
  template <typename Report>
  std::map<std::size_t, Moves> measure(const PairSelection& selection, Report&& report) const
  {
    std::map<std::size_t, Moves> moves;
    for (int slab = 0; slab < this->InSlabs.count; ++slab)
    {
      this->measureSlab(slab, selection, moves);
      report(double(slab + 1) / this->InSlabs.count);
    }
    return this->Shared.size() > 1 ? joined(this->Shared.exchange(bytesOf(moves))) : moves;
  }

  void move(const std::vector<std::size_t>& moving, const std::map<std::size_t, Moves>& moves)
  {
    this->Shared.loop(
      moving.size(), this->Caller,
      [&](std::size_t m)
      {
        const std::size_t s = moving[m];
        TriangleMesh mesh = *this->Surfaces.get(s);
        moveInwards(mesh, moves.at(s), this->Box, this->Gap);
        this->Boxes[s] = boxesBySlab(mesh, this->InSlabs);
        this->Surfaces.put(s, std::move(mesh));
      },
      [&](std::size_t m) { return bytesOf(this->Boxes[moving[m]]); },
      [&](std::size_t m, const std::string& bytes)
      {
        this->Boxes[moving[m]] = boxesFrom(bytes);
        this->Surfaces.putElsewhere(moving[m]);
      });
  }

private:
  std::vector<Pair> neighbours(int slab, const PairSelection& selection) const;
  void measureSlab(int slab, const PairSelection& selection, std::map<std::size_t, Moves>& moves) const;

  SurfaceStore& Surfaces;
  double Gap;
  Eigen::AlignedBox3d Box;
  const Context& Caller;
  const Sharing& Shared;
  Slabs InSlabs;
  std::vector<SlabBoxes> Boxes;
};

/// Pairs to look at, whose boxes in the slab come nearer than the gap.
std::vector<Pair> Spacing::neighbours(int slab, const PairSelection& selection) const
{
  struct Place
  {
    std::size_t surface;
    const Eigen::AlignedBox3d* box;
  };
  std::vector<Place> places;
  bool isAnyChanged = false;
  for (std::size_t s = 0; s < this->Boxes.size(); ++s)
  {
    if (const Eigen::AlignedBox3d* box = this->Boxes[s].in(slab))
    {
      places.push_back({ s, box });
      isAnyChanged = isAnyChanged || selection.isChanged[s];
    }
  }
  std::vector<Pair> pairs;
  if (!isAnyChanged)
  {
    return pairs;
  }
  std::stable_sort(
    places.begin(), places.end(), [](const Place& a, const Place& b) { return a.box->min()[0] < b.box->min()[0]; });
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const Place& a = places[i];
    for (std::size_t j = i + 1; j < places.size() && places[j].box->min()[0] <= a.box->max()[0] + this->Gap; ++j)
    {
      const Place& b = places[j];
      if (selection.holds(a.surface, b.surface) && a.box->squaredExteriorDistance(*b.box) < this->Gap * this->Gap)
      {
        pairs.push_back({ a.surface, b.surface, 0.0, {}, {} });
      }
    }
  }
  return pairs;
}

/// Adds, per surface, how far points have to move for those pairs in a slab that are this process's: a run of them, since pairs
/// that follow each other have surfaces in common.
void Spacing::measureSlab(int slab, const PairSelection& selection, std::map<std::size_t, Moves>& moves) const
{
  std::vector<Pair> pairs = this->neighbours(slab, selection);
  const auto startOf = [&](int place)
  { return std::ptrdiff_t(pairs.size() * std::size_t(place) / std::size_t(this->Shared.size())); };
  const int place = this->Shared.place();
  pairs = std::vector<Pair>(pairs.begin() + startOf(place), pairs.begin() + startOf(place + 1));
  std::map<std::size_t, Part> parts;
  for (const Pair& pair : pairs)
  {
    parts[pair.one];
    parts[pair.other];
  }
  std::vector<std::pair<const std::size_t, Part>*> entries;
  entries.reserve(parts.size());
  for (auto& entry : parts)
  {
    entries.push_back(&entry);
  }
  parallelFor(entries.size(), this->Caller,
    [&](std::size_t i)
    {
      auto& [surface, part] = *entries[i];
      cutOut(*this->Surfaces.get(surface), this->InSlabs.lower(slab), this->InSlabs.upper(slab), part);
    });
  parallelFor(pairs.size(), this->Caller,
    [&](std::size_t p) { measureGap(pairs[p], *parts.at(pairs[p].one).tree, *parts.at(pairs[p].other).tree, this->Gap); });
  for (const Pair& pair : pairs)
  {
    if (pair.missing > 0.0)
    {
      const double distance = 0.5 * pair.missing + extraDistance;
      addMoves(moves[pair.one], parts.at(pair.one), pair.trianglesOfOne, distance);
      addMoves(moves[pair.other], parts.at(pair.other), pair.trianglesOfOther, distance);
    }
  }
}

} // namespace

SpacingReport keepApart(SurfaceStore& surfaces, const std::vector<std::size_t>& changed, double smallest,
  const Eigen::AlignedBox3d& box, const Context& context, double from, double to, const Sharing& sharing)
{
  SpacingReport report;
  if (!(smallest > 0.0))
  {
    return report;
  }
  PairSelection selection;
  selection.isGiven.resize(surfaces.size(), 0);
  for (const std::size_t s : changed)
  {
    selection.isGiven[s] = 1;
  }
  selection.isChanged = selection.isGiven;
  Spacing spacing(surfaces, smallest + rounding, box, context, sharing);
  std::set<std::size_t> moved;
  // Most of the work is the first look at all surfaces.
  const double half = 0.5 * (from + to);
  for (int round = 0;; ++round)
  {
    const std::map<std::size_t, Moves> moves = spacing.measure(
      selection, [&](double part) { context.report((round == 0 ? from : half) + (half - from) * part, "keeping fibres apart"); });
    std::vector<std::size_t> moving;
    moving.reserve(moves.size());
    for (const auto& entry : moves)
    {
      moving.push_back(entry.first);
    }
    if (moving.empty() || round == rounds)
    {
      report.tooNear = moving;
      break;
    }
    std::fill(selection.isChanged.begin(), selection.isChanged.end(), 0);
    for (const std::size_t s : moving)
    {
      selection.isChanged[s] = 1;
      selection.isGiven[s] = 1; // large triangles may come nearer to a third one as they turn
      moved.insert(s);
    }
    spacing.move(moving, moves);
  }
  report.moved.assign(moved.begin(), moved.end());
  return report;
}

SpacingReport keepApart(
  SurfaceStore& surfaces, double gap, const Eigen::AlignedBox3d& box, const Context& context, double from, double to)
{
  std::vector<std::size_t> all(surfaces.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  return keepApart(surfaces, all, gap, box, context, from, to);
}

} // namespace cactus
