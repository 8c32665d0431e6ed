// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceSpacing.h"

#include "base/Domain.h"
#include "base/Parallel.h"
#include "mesh/BoxTree.h"
#include "mesh/CappedSurface.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/TriangleTree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Extra distance (µm) by which a pair is moved, since rounding and oblique moves of corners undo some of it. More than
/// lostInFiles.
constexpr double extraDistance = 0.0002;
/// Surfaces that meet are moved as if they had to keep this distance (µm), or the gap if that is larger: they first have to get
/// out of each other.
constexpr double distanceAfterMeeting = 0.005;
/// Most pairs take one or two rounds; corners with oblique normals, as on a face that cuts a fibre at a small angle, part slowly.
constexpr int rounds = 48;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Thickness (µm) of the slabs along z, so that trees cover only one slab at a time.
constexpr double slabThickness = 10.0;

/// The slabs of a box, each extended by the gap: where two surfaces are too near, both are in the slab of that place.
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
  bool isTouched(int slab, double from, double to) const { return to >= this->lower(slab) && from <= this->upper(slab); }
  /// Returns the slab of a height, which may be outside the box.
  int at(double z) const
  {
    return static_cast<int>(std::clamp(std::floor((z - this->first) / slabThickness), 0.0, this->count - 1.0));
  }

  /// Calls visit(slab) for those that a range of heights touches.
  template <typename Visit>
  void visitTouched(double from, double to, Visit&& visit) const
  {
    // One more on either side: rounding, and the gap.
    const int last = std::min(this->count - 1, this->at(to + this->gap) + 1);
    for (int slab = std::max(0, this->at(from - this->gap) - 1); slab <= last; ++slab)
    {
      if (this->isTouched(slab, from, to))
      {
        visit(slab);
      }
    }
  }

  double first;
  double gap;
  int count;
};

/// The extent of a surface in a slab.
struct SlabBox
{
  Eigen::AlignedBox3d box;
  bool isChanged = false; ///< since it was measured
};

auto membersOf(SlabBox& slab)
{
  return std::tie(slab.box.min(), slab.box.max(), slab.isChanged);
}

/// The extents of a surface in consecutive slabs, from its first one.
struct SlabBoxes
{
  int first = 0;
  std::vector<SlabBox> boxes;

  /// Returns that of a slab between the first and the last.
  SlabBox& in(int slab) { return this->boxes[std::size_t(slab - this->first)]; }
};

auto membersOf(SlabBoxes& slabs)
{
  return std::tie(slabs.first, slabs.boxes);
}

/// The part of a surface in a slab, with its search tree.
struct TreedPart
{
  SurfacePart part;
  std::unique_ptr<TriangleTree> tree; ///< over the part's mesh
};

/// Two surfaces whose parts are near each other, and the triangles that are too near.
struct Pair
{
  std::size_t one;
  std::size_t other;
  std::size_t image = 0; ///< of the other one: 0 for itself, or 1 + the number of its shift
  double missing = 0.0;  ///< µm, of the gap
  std::vector<std::uint32_t> trianglesOfOne;
  std::vector<std::uint32_t> trianglesOfOther;
};

/// The displacements (µm) of those points of a surface that have to move; of several distances, the largest counts.
class Moves
{
public:
  struct Move
  {
    std::int32_t point;
    double distance;
  };

  void add(std::int32_t point, double distance) { this->All.push_back({ point, distance }); }
  void add(const Moves& more) { this->All.insert(this->All.end(), more.All.begin(), more.All.end()); }

  /// Sorts the moves; to be called after additions.
  void sort()
  {
    const auto isBefore = [](const Move& a, const Move& b)
    { return a.point != b.point ? a.point < b.point : a.distance > b.distance; };
    const auto isSame = [](const Move& a, const Move& b) { return a.point == b.point; };
    std::sort(this->All.begin(), this->All.end(), isBefore);
    this->All.erase(std::unique(this->All.begin(), this->All.end(), isSame), this->All.end());
  }

  /// Tells whether a point moves. Precondition for these: sorted.
  bool has(std::int32_t point) const
  {
    const auto isBefore = [](const Move& move, std::int32_t wanted) { return move.point < wanted; };
    const auto found = std::lower_bound(this->All.begin(), this->All.end(), point, isBefore);
    return found != this->All.end() && found->point == point;
  }
  bool hasAny(const std::array<std::int32_t, 3>& points) const
  {
    return this->has(points[0]) || this->has(points[1]) || this->has(points[2]);
  }
  const std::vector<Move>& all() const { return this->All; }

  friend auto membersOf(Move& move) { return std::tie(move.point, move.distance); }
  friend auto membersOf(Moves& moves) { return std::tie(moves.All); }

private:
  std::vector<Move> All;
};

void moveInwards(TriangleMesh& mesh, const Moves& moves, const Eigen::AlignedBox3d& box, std::uint8_t held, double margin)
{
  const auto onFace = [&](std::int32_t p, Eigen::Index axis, int side)
  { return mesh.points[std::size_t(p)][axis] == (side == 0 ? box.min()[axis] : box.max()[axis]); };
  std::map<std::int32_t, Vector3d> normals;
  for (const auto& t : mesh.triangles)
  {
    if (!moves.hasAny(t))
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
  for (const auto& [point, distance] : moves.all())
  {
    const auto found = normals.find(point);
    if (found == normals.end())
    {
      continue; // inside a cap
    }
    Vector3d normal = found->second;
    for (int face = 0; face < 6; ++face)
    {
      if ((held >> face & 1) != 0 && onFace(point, face / 2, face % 2))
      {
        normal.setZero();
      }
    }
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

void addMoves(Moves& moves, const SurfacePart& part, const std::vector<std::uint32_t>& triangles, double distance)
{
  for (const std::uint32_t t : triangles)
  {
    for (const std::int32_t corner : part.mesh.triangles[t])
    {
      moves.add(part.pointOf[std::size_t(corner)], distance);
    }
  }
}

Eigen::AlignedBox3d boxOf(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t)
{
  Eigen::AlignedBox3d box;
  for (const std::int32_t corner : t)
  {
    box.extend(mesh.points[std::size_t(corner)]);
  }
  return box;
}

Eigen::AlignedBox3d shifted(const Eigen::AlignedBox3d& box, const Vector3d& shift)
{
  return { box.min() + shift, box.max() + shift };
}

/// Returns the shifts to the images of a box that repeats beyond the held faces.
std::vector<Vector3d> shiftsOf(const Eigen::AlignedBox3d& box, std::uint8_t held)
{
  Domain domain;
  domain.lower = box.min();
  domain.upper = box.max();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    domain.periodic[axis] = (held >> (2 * axis) & 3) == 3;
  }
  return domain.shiftsToImages();
}

/// Returns the extents of a surface by slab, all unchanged.
SlabBoxes boxesBySlab(const TriangleMesh& mesh, const Slabs& slabs)
{
  SlabBoxes result;
  if (mesh.points.empty())
  {
    return result;
  }
  const auto byHeight = [](const Vector3d& a, const Vector3d& b) { return a[2] < b[2]; };
  const auto [lowest, highest] = std::minmax_element(mesh.points.begin(), mesh.points.end(), byHeight);
  // One slab more on either side, as in visitTouched().
  result.first = std::max(0, slabs.at((*lowest)[2] - slabs.gap) - 1);
  result.boxes.resize(std::size_t(std::min(slabs.count - 1, slabs.at((*highest)[2] + slabs.gap) + 1) - result.first + 1));
  for (const auto& t : mesh.triangles)
  {
    const Eigen::AlignedBox3d triangle = boxOf(mesh, t);
    slabs.visitTouched(triangle.min()[2], triangle.max()[2], [&](int slab) { result.in(slab).box.extend(triangle); });
  }
  return result;
}

/// Marks the slabs in which triangles have a corner that will move, or has moved.
void markChanged(const TriangleMesh& mesh, const Moves& moves, const Slabs& slabs, SlabBoxes& boxes)
{
  for (const auto& t : mesh.triangles)
  {
    if (moves.hasAny(t))
    {
      const Eigen::AlignedBox3d triangle = boxOf(mesh, t);
      slabs.visitTouched(triangle.min()[2], triangle.max()[2], [&](int slab) { boxes.in(slab).isChanged = true; });
    }
  }
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

/// Keeps the marks of earlier changes.
void keepMarks(SlabBoxes& before, SlabBoxes& boxes)
{
  const auto endOf = [](const SlabBoxes& of) { return of.first + static_cast<int>(of.boxes.size()); };
  for (int slab = std::max(before.first, boxes.first); slab < std::min(endOf(before), endOf(boxes)); ++slab)
  {
    boxes.in(slab).isChanged = boxes.in(slab).isChanged || before.in(slab).isChanged;
  }
}

FloatBox floatBox(const Eigen::AlignedBox3d& box)
{
  return FloatBox::around(box.min(), box.max(), box.max());
}

/// Joins the maps of all processes, each given as the bytes of several maps in sequence.
std::map<std::size_t, Moves> joined(const std::vector<std::string>& all)
{
  std::map<std::size_t, Moves> moves;
  for (const std::string& bytes : all)
  {
    for (ByteReader get(bytes); !get.isAtEnd();)
    {
      for (const auto& [surface, ofSurface] : get.get<std::map<std::size_t, Moves>>())
      {
        moves[surface].add(ofSurface);
      }
    }
  }
  for (auto& entry : moves)
  {
    entry.second.sort();
  }
  return moves;
}

/// Finds surfaces that are too near, slab by slab, and moves them.
class Spacing
{
public:
  /// `given` are the surfaces that others may be too near to.
  Spacing(SurfaceStore& surfaces, const std::vector<std::size_t>& given, double gap, const Eigen::AlignedBox3d& box,
    std::uint8_t held, const Context& context, const Sharing& sharing)
    : Surfaces(surfaces)
    , Gap(gap)
    , Box(box)
    , Held(held)
    , Caller(context)
    , Shared(sharing)
    , Shifts(shiftsOf(box, held))
    , InSlabs(box, gap)
    , Boxes(surfaces.size())
    , IsGiven(surfaces.size(), 0)
  {
    this->Shared.loop(
      surfaces.size(), context, [this](std::size_t s) { this->Boxes[s] = boxesBySlab(*this->Surfaces.get(s), this->InSlabs); },
      [this](std::size_t s) { return bytesOf(this->Boxes[s]); },
      [this](std::size_t s, const std::string& bytes) { getAll(bytes, this->Boxes[s]); });
    for (const std::size_t s : given)
    {
      this->give(s);
    }
  }

  /// Returns the displacements of the surfaces' points. It measures only those pairs and slabs where one of the two is given and
  /// one has changed since the last time; elsewhere the result would again be nothing. `report(part)` receives the completed
  /// fraction. The cached results in `known` depend on which pairs belong to this process.
  template <typename Report>
  std::map<std::size_t, Moves> measure(const Recollection& known, Report&& report)
  {
    const Recollection own = known.part(std::to_string(this->Shared.place()) + " of " + std::to_string(this->Shared.size()));
    std::string found; // slab by slab
    std::vector<std::vector<std::size_t>> held = this->surfacesBySlab();
    for (int slab = 0; slab < this->InSlabs.count; ++slab)
    {
      const Recollection ofSlab = own.part(std::to_string(slab));
      std::optional<std::string> moves = ofSlab.recall();
      if (!moves)
      {
        moves = bytesOf(this->movesInSlab(slab, held));
        ofSlab.note(*moves);
      }
      found += *moves;
      if (slab > 0) // the first one's are beyond the last one, too
      {
        held[std::size_t(slab)] = {};
      }
      report(double(slab + 1) / this->InSlabs.count);
    }
    return joined(this->Shared.exchange(found));
  }

  void move(const std::vector<std::size_t>& moving, const std::map<std::size_t, Moves>& moves)
  {
    for (SlabBoxes& boxes : this->Boxes)
    {
      for (SlabBox& slab : boxes.boxes)
      {
        slab.isChanged = false;
      }
    }
    this->Shared.loop(
      moving.size(), this->Caller,
      [&](std::size_t m)
      {
        const std::size_t s = moving[m];
        TriangleMesh mesh = *this->Surfaces.get(s);
        SlabBoxes before = this->Boxes[s];
        markChanged(mesh, moves.at(s), this->InSlabs, before);
        moveInwards(mesh, moves.at(s), this->Box, this->Held, this->Gap);
        this->Boxes[s] = boxesBySlab(mesh, this->InSlabs);
        markChanged(mesh, moves.at(s), this->InSlabs, this->Boxes[s]);
        keepMarks(before, this->Boxes[s]);
        this->Surfaces.put(s, std::move(mesh));
      },
      [&](std::size_t m) { return bytesOf(this->Boxes[moving[m]], this->Surfaces.bytesOf(moving[m])); },
      [&](std::size_t m, const std::string& bytes)
      {
        std::string surface;
        getAll(bytes, this->Boxes[moving[m]], surface);
        this->Surfaces.putElsewhere(moving[m], surface);
      });
    for (const std::size_t s : moving)
    {
      if (!this->IsGiven[s])
      {
        this->give(s); // large triangles may come nearer to a third surface as they turn
      }
    }
  }

private:
  void give(std::size_t surface)
  {
    this->IsGiven[surface] = 1;
    for (SlabBox& slab : this->Boxes[surface].boxes)
    {
      slab.isChanged = true;
    }
  }
  std::vector<std::vector<std::size_t>> surfacesBySlab();
  std::vector<Pair> neighbours(int slab, const std::vector<std::size_t>& held);
  std::vector<Pair> neighboursAcross(int slab, std::size_t image, const std::vector<std::vector<std::size_t>>& held);
  std::vector<Pair> pairsIn(int slab, const std::vector<std::vector<std::size_t>>& held);
  std::map<std::size_t, Moves> movesInSlab(int slab, const std::vector<std::vector<std::size_t>>& held);
  bool isAbove(std::size_t image) const { return image > 0 && this->Shifts[image - 1][2] > 0.0; }
  /// Returns the slab of a pair's other surface.
  int slabOf(int slab, std::size_t image) const { return this->isAbove(image) ? 0 : slab; }

  SurfaceStore& Surfaces;
  double Gap;
  Eigen::AlignedBox3d Box;
  std::uint8_t Held;
  const Context& Caller;
  const Sharing& Shared;
  std::vector<Vector3d> Shifts; ///< to images of the box, see Domain::shiftsToImages()
  Slabs InSlabs;
  std::vector<SlabBoxes> Boxes;
  std::vector<char> IsGiven; ///< whether pairs with it are measured
};

/// Returns the surfaces in each slab where one has changed; beyond the last slab lies the first one again, if the box repeats.
std::vector<std::vector<std::size_t>> Spacing::surfacesBySlab()
{
  std::vector<std::vector<std::size_t>> held(std::size_t(this->InSlabs.count));
  std::vector<char> isAnyChanged(held.size(), 0);
  for (std::size_t s = 0; s < this->Boxes.size(); ++s)
  {
    std::size_t slab = std::size_t(this->Boxes[s].first);
    for (const SlabBox& part : this->Boxes[s].boxes)
    {
      if (!part.box.isEmpty())
      {
        held[slab].push_back(s);
        isAnyChanged[slab] = isAnyChanged[slab] != 0 || part.isChanged ? 1 : 0;
      }
      ++slab;
    }
  }
  if (this->isAbove(this->Shifts.size()))
  {
    isAnyChanged.front() = isAnyChanged.back() = std::max(isAnyChanged.front(), isAnyChanged.back());
  }
  for (std::size_t slab = 0; slab < held.size(); ++slab)
  {
    if (isAnyChanged[slab] == 0)
    {
      held[slab] = {};
    }
  }
  return held;
}

/// Returns the pairs to measure, whose boxes in the slab come nearer than the gap: sorted along x, each with those to one side.
std::vector<Pair> Spacing::neighbours(int slab, const std::vector<std::size_t>& held)
{
  std::vector<std::size_t> surfaces = held;
  const auto boxAt = [&](std::size_t place) -> const SlabBox& { return this->Boxes[surfaces[place]].in(slab); };
  std::stable_sort(surfaces.begin(), surfaces.end(),
    [&](std::size_t a, std::size_t b) { return this->Boxes[a].in(slab).box.min()[0] < this->Boxes[b].in(slab).box.min()[0]; });
  std::vector<BoxTree::Item> changed;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    if (boxAt(i).isChanged)
    {
      changed.push_back({ floatBox(boxAt(i).box), static_cast<std::uint32_t>(i) });
    }
  }
  const BoxTree tree(std::move(changed));
  const double squaredGap = this->Gap * this->Gap;
  std::vector<std::vector<std::size_t>> near(surfaces.size());
  parallelFor(surfaces.size(), this->Caller,
    [&](std::size_t i)
    {
      const SlabBox& own = boxAt(i);
      const FloatBox rough = floatBox(own.box);
      visitEntries(
        tree, [&](const FloatBox& box) { return double(rough.squaredDistance(box)) < squaredGap; },
        [&](std::size_t j)
        {
          // Of two changed surfaces, each finds the other.
          const bool isOwn = own.isChanged ? i < j : i != j;
          if (isOwn && (this->IsGiven[surfaces[i]] || this->IsGiven[surfaces[j]]) &&
              own.box.squaredExteriorDistance(boxAt(j).box) < squaredGap)
          {
            near[i].push_back(j);
          }
          return false;
        });
    });
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    for (const std::size_t j : near[i])
    {
      places.emplace_back(std::min(i, j), std::max(i, j));
    }
  }
  std::sort(places.begin(), places.end());
  std::vector<Pair> pairs;
  pairs.reserve(places.size());
  for (const auto& [one, other] : places)
  {
    pairs.push_back({ surfaces[one], surfaces[other], 0, 0.0, {}, {} });
  }
  return pairs;
}

/// Returns the pairs to measure of a surface in a slab and an image of another one, whose boxes come nearer than the gap.
std::vector<Pair> Spacing::neighboursAcross(int slab, std::size_t image, const std::vector<std::vector<std::size_t>>& held)
{
  const double squaredGap = this->Gap * this->Gap;
  const int beyond = this->slabOf(slab, image);
  const auto boxBeyond = [&](std::size_t s) { return shifted(this->Boxes[s].in(beyond).box, this->Shifts[image - 1]); };
  std::vector<BoxTree::Item> near;
  for (const std::size_t s : held[std::size_t(beyond)])
  {
    if (this->Box.squaredExteriorDistance(boxBeyond(s)) < squaredGap)
    {
      near.push_back({ floatBox(boxBeyond(s)), static_cast<std::uint32_t>(s) });
    }
  }
  const BoxTree tree(std::move(near));
  std::vector<Pair> pairs;
  for (const std::size_t s : held[std::size_t(slab)])
  {
    const SlabBox& own = this->Boxes[s].in(slab);
    const FloatBox rough = floatBox(own.box);
    std::vector<std::size_t> found;
    visitEntries(
      tree, [&](const FloatBox& box) { return double(rough.squaredDistance(box)) < squaredGap; },
      [&](std::size_t other)
      {
        if (other != s && (this->IsGiven[s] || this->IsGiven[other]) &&
            (own.isChanged || this->Boxes[other].in(beyond).isChanged) &&
            own.box.squaredExteriorDistance(boxBeyond(other)) < squaredGap)
        {
          found.push_back(other);
        }
        return false;
      });
    std::sort(found.begin(), found.end());
    for (const std::size_t other : found)
    {
      pairs.push_back({ s, other, image, 0.0, {}, {} });
    }
  }
  return pairs;
}

/// Returns the pairs to measure in a slab, and across the faces that it reaches.
std::vector<Pair> Spacing::pairsIn(int slab, const std::vector<std::vector<std::size_t>>& held)
{
  std::vector<Pair> pairs = this->neighbours(slab, held[std::size_t(slab)]);
  for (std::size_t image = 1; image <= this->Shifts.size(); ++image)
  {
    if (!this->isAbove(image) || slab == this->InSlabs.count - 1)
    {
      std::vector<Pair> more = this->neighboursAcross(slab, image, held);
      std::move(more.begin(), more.end(), std::back_inserter(pairs));
    }
  }
  return pairs;
}

/// Returns the displacements, by surface, for those pairs in a slab that belong to this process: a contiguous range, since
/// consecutive pairs share surfaces.
std::map<std::size_t, Moves> Spacing::movesInSlab(int slab, const std::vector<std::vector<std::size_t>>& held)
{
  std::vector<Pair> pairs = this->pairsIn(slab, held);
  const auto startOf = [&](int place)
  { return std::ptrdiff_t(pairs.size() * std::size_t(place) / std::size_t(this->Shared.size())); };
  const int place = this->Shared.place();
  pairs = std::vector<Pair>(pairs.begin() + startOf(place), pairs.begin() + startOf(place + 1));
  using SurfaceImage = std::pair<std::size_t, std::size_t>;
  std::map<SurfaceImage, TreedPart> parts;
  for (const Pair& pair : pairs)
  {
    parts[{ pair.one, 0 }];
    parts[{ pair.other, pair.image }];
  }
  std::vector<std::pair<const SurfaceImage, TreedPart>*> entries;
  entries.reserve(parts.size());
  for (auto& entry : parts)
  {
    entries.push_back(&entry);
  }
  parallelFor(entries.size(), this->Caller,
    [&](std::size_t i)
    {
      auto& [of, treed] = *entries[i];
      const int from = this->slabOf(slab, of.second);
      treed.part = this->Surfaces.part(of.first, this->InSlabs.lower(from), this->InSlabs.upper(from));
      if (of.second > 0)
      {
        for (Vector3d& point : treed.part.mesh.points)
        {
          point += this->Shifts[of.second - 1];
        }
      }
      treed.tree = std::make_unique<TriangleTree>(treed.part.mesh);
    });
  parallelFor(pairs.size(), this->Caller,
    [&](std::size_t p)
    {
      Pair& pair = pairs[p];
      measureGap(pair, *parts.at({ pair.one, 0 }).tree, *parts.at({ pair.other, pair.image }).tree, this->Gap);
    });
  std::map<std::size_t, Moves> moves;
  for (const Pair& pair : pairs)
  {
    if (pair.missing > 0.0)
    {
      const double distance = 0.5 * pair.missing + extraDistance;
      addMoves(moves[pair.one], parts.at({ pair.one, 0 }).part, pair.trianglesOfOne, distance);
      addMoves(moves[pair.other], parts.at({ pair.other, pair.image }).part, pair.trianglesOfOther, distance);
    }
  }
  for (auto& entry : moves)
  {
    entry.second.sort();
  }
  return moves;
}

} // namespace

SpacingReport keepApart(SurfaceStore& surfaces, const std::vector<std::size_t>& changed, double smallest,
  const Eigen::AlignedBox3d& box, const Context& context, double from, double to, const Sharing& sharing,
  const Recollection& known, std::uint8_t held)
{
  SpacingReport report;
  if (!(smallest > 0.0))
  {
    return report;
  }
  Spacing spacing(surfaces, changed, smallest + lostInFiles, box, held, context, sharing);
  std::set<std::size_t> moved;
  // Most of the work is the first measurement of all surfaces.
  const double half = 0.5 * (from + to);
  for (int round = 0;; ++round)
  {
    const std::map<std::size_t, Moves> moves = spacing.measure(known.part("round " + std::to_string(round)),
      [&](double part) { context.report((round == 0 ? from : half) + (half - from) * part, "keeping fibres apart"); });
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
    moved.insert(moving.begin(), moving.end());
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
