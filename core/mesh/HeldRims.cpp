// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/HeldRims.h"

#include "mesh/EditableSurface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

namespace cactus
{

namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Consecutive points of a rim in one face, in the same sense seen along the axis for both faces across it.
struct RimLine
{
  std::vector<std::int32_t> points;
  bool isLoop = false; ///< the first one follows the last one
};

/// The rims of a surface in one face.
class FaceRims
{
public:
  FaceRims(const CappedSurface& surface, int face)
    : Surface(surface)
    , Axis(face / 2)
  {
    std::set<std::pair<std::int32_t, std::int32_t>> wall;
    for (const auto& t : surface.mesh.triangles)
    {
      for (std::size_t i = 0; i < 3 && !surface.isCap(t); ++i)
      {
        const auto [a, b] = std::pair(t[i], t[(i + 1) % 3]);
        if ((surface.faces[std::size_t(a)] & surface.faces[std::size_t(b)] & (1U << face)) != 0)
        {
          wall.emplace(a, b);
        }
      }
    }
    for (const auto& t : surface.mesh.triangles)
    {
      if ((surface.faces[std::size_t(t[0])] & surface.faces[std::size_t(t[1])] & surface.faces[std::size_t(t[2])] &
            (1U << face)) == 0)
      {
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i)
      {
        const auto [a, b] = std::pair(t[i], t[(i + 1) % 3]);
        if (wall.count({ b, a }) != 0)
        {
          const auto [from, to] = face % 2 == 0 ? std::pair(b, a) : std::pair(a, b); // caps face outwards
          this->IsSimple = this->Next.emplace(from, to).second && this->IsSimple;
          this->IsSimple = this->Before.emplace(to, from).second && this->IsSimple;
        }
      }
    }
  }

  /// Returns the rims; none if they touch each other.
  std::vector<RimLine> lines()
  {
    std::vector<RimLine> lines;
    for (const auto& edge : this->Next)
    {
      if (this->IsSimple && this->Before.count(edge.first) == 0)
      {
        lines.push_back(this->lineFrom(edge.first));
      }
    }
    std::set<std::int32_t> done;
    for (const RimLine& line : lines)
    {
      done.insert(line.points.begin(), line.points.end());
    }
    for (const auto& edge : this->Next)
    {
      if (this->IsSimple && done.count(edge.first) == 0)
      {
        RimLine loop = this->lineFrom(edge.first);
        const auto first = std::min_element(loop.points.begin(), loop.points.end(),
          [this](std::int32_t a, std::int32_t b)
          { return std::pair(this->at(a).x(), this->at(a).y()) < std::pair(this->at(b).x(), this->at(b).y()); });
        std::rotate(loop.points.begin(), first, loop.points.end());
        done.insert(loop.points.begin(), loop.points.end());
        lines.push_back(std::move(loop));
      }
    }
    return lines;
  }

  /// Returns the indices of the points of a line that stay, first and last among them.
  std::vector<std::size_t> kept(const RimLine& line, double error, double longest) const
  {
    const std::size_t count = line.points.size() + (line.isLoop ? 1 : 0);
    std::vector<std::size_t> few{ 0 };
    while (few.back() + 1 < count)
    {
      std::size_t next = few.back() + 1;
      while (next + 1 < count && this->isNear(line, few.back(), next + 1, error, longest))
      {
        ++next;
      }
      few.push_back(next);
    }
    if (few.size() < this->fewest(line) && count > few.size())
    {
      const std::size_t farthest = this->farthest(line, few[1]);
      few.insert(std::upper_bound(few.begin(), few.end(), farthest), farthest);
    }
    return few;
  }

private:
  Vector2d at(std::int32_t point) const
  {
    const Vector3d& p = this->Surface.mesh.points[std::size_t(point)];
    return { p[(this->Axis + 1) % 3], p[(this->Axis + 2) % 3] };
  }

  RimLine lineFrom(std::int32_t first) const
  {
    RimLine line;
    std::int32_t point = first;
    for (;;)
    {
      line.points.push_back(point);
      const auto next = this->Next.find(point);
      if (next == this->Next.end())
      {
        return line;
      }
      point = next->second;
      if (point == first)
      {
        line.isLoop = true;
        return line;
      }
    }
  }

  /// Returns how many points stay at least, so that the cap beside the line does not vanish: a loop ends in its first point, and
  /// a line with both ends on one edge of the box encloses the cap with that edge.
  std::size_t fewest(const RimLine& line) const
  {
    const unsigned others = ~(3U << (2 * this->Axis));
    const auto facesOf = [this](std::int32_t point) { return unsigned(this->Surface.faces[std::size_t(point)]); };
    const bool isOnOneEdge = (facesOf(line.points.front()) & facesOf(line.points.back()) & others) != 0;
    return line.isLoop ? 4 : isOnOneEdge ? 3 : 2;
  }

  /// Returns the point of a line that is farthest from the chord between the first one and another.
  std::size_t farthest(const RimLine& line, std::size_t to) const
  {
    const Vector2d a = this->at(line.points.front());
    const Vector2d along = this->at(line.points[to % line.points.size()]) - a;
    std::size_t found = 0;
    double largest = -1.0;
    for (std::size_t i = 1; i < line.points.size(); ++i)
    {
      const Vector2d off = this->at(line.points[i]) - a;
      const double distance = std::abs(along.x() * off.y() - along.y() * off.x());
      if (i != to && distance > largest)
      {
        largest = distance;
        found = i;
      }
    }
    return found;
  }

  /// Tells whether the points between two of a line are near their chord, and in order along it.
  bool isNear(const RimLine& line, std::size_t from, std::size_t to, double error, double longest) const
  {
    const Vector2d a = this->at(line.points[from]);
    const Vector2d along = this->at(line.points[to % line.points.size()]) - a;
    const double length = along.norm();
    if (!(length > 0.0) || length > longest)
    {
      return false;
    }
    double before = 0.0;
    for (std::size_t i = from + 1; i < to; ++i)
    {
      const Vector2d off = this->at(line.points[i]) - a;
      const double part = along.dot(off) / length;
      if (std::abs(along.x() * off.y() - along.y() * off.x()) > error * length || part < before || part > length)
      {
        return false;
      }
      before = part;
    }
    return true;
  }

  const CappedSurface& Surface;
  Eigen::Index Axis;
  bool IsSimple = true;
  std::map<std::int32_t, std::int32_t> Next; ///< per point of a rim
  std::map<std::int32_t, std::int32_t> Before;
};

} // namespace

HeldRims::HeldRims(const CappedSurface& surface, double error, double longest)
{
  const bool hasRims =
    std::any_of(surface.faces.begin(), surface.faces.end(), [&](std::uint8_t faces) { return (faces & surface.held) != 0; });
  if (!hasRims)
  {
    return;
  }
  const auto placeOf = [&](std::int32_t point) -> Place
  {
    const Vector3d& p = surface.mesh.points[std::size_t(point)];
    return { { p.x(), p.y(), p.z() } };
  };
  auto stays = std::make_shared<std::set<Place>>();
  for (int axis = 0; axis < 3; ++axis)
  {
    if ((surface.held >> (2 * axis) & 1) == 0)
    {
      continue;
    }
    std::map<std::array<double, 2>, Pair> byFirst; // the first point in the plane names the rim
    for (const int side : { 0, 1 })
    {
      FaceRims rims(surface, 2 * axis + side);
      for (const RimLine& line : rims.lines())
      {
        for (const std::size_t i : rims.kept(line, error, longest))
        {
          stays->insert(placeOf(line.points[i % line.points.size()]));
        }
        const Place first = placeOf(line.points.front());
        std::vector<Place>& places =
          byFirst[{ { first[std::size_t(axis + 1) % 3], first[std::size_t(axis + 2) % 3] } }][std::size_t(side)];
        std::transform(line.points.begin(), line.points.end(), std::back_inserter(places), placeOf);
        if (line.isLoop)
        {
          places.push_back(first);
        }
      }
    }
    for (auto& rim : byFirst)
    {
      if (rim.second[0].size() == rim.second[1].size())
      {
        this->Rims.push_back(std::move(rim.second));
      }
    }
  }
  this->Stays = std::move(stays);
}

void HeldRims::join(CappedSurface& surface) const
{
  if (this->Rims.empty())
  {
    return;
  }
  std::map<Place, std::int32_t> pointAt;
  for (std::size_t p = 0; p < surface.mesh.points.size(); ++p)
  {
    if (surface.isHeld(static_cast<std::int32_t>(p)))
    {
      const Vector3d& place = surface.mesh.points[p];
      pointAt[{ { place.x(), place.y(), place.z() } }] = static_cast<std::int32_t>(p);
    }
  }
  EditableSurface edited(surface);
  for (const Pair& rim : this->Rims)
  {
    std::array<std::int32_t, 2> last{ { -1, -1 } };
    std::array<std::vector<std::size_t>, 2> missing; // since the last point that both have
    for (std::size_t i = 0; i < rim[0].size(); ++i)
    {
      std::array<std::int32_t, 2> here{ { -1, -1 } };
      for (const std::size_t side : { 0, 1 })
      {
        const auto found = pointAt.find(rim[side][i]);
        here[side] = found != pointAt.end() ? found->second : -1;
      }
      for (const std::size_t side : { 0, 1 })
      {
        if (here[side] < 0 && here[1 - side] >= 0)
        {
          missing[side].push_back(i);
        }
        else if (here[side] >= 0)
        {
          for (const std::size_t m : missing[side])
          {
            if (last[side] >= 0 && edited.areLinked(last[side], here[side]))
            {
              const Place& place = rim[side][m];
              last[side] = edited.split(last[side], here[side], Vector3d(place[0], place[1], place[2]));
            }
          }
          missing[side].clear();
          last[side] = here[side];
        }
      }
    }
  }
  edited.compact();
}

} // namespace cactus
