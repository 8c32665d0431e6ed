// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/NeedleSplitting.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace cactus
{

namespace
{

class NeedleSplitter
{
public:
  NeedleSplitter(CappedSurface& surface, double largest)
    : Surface(surface)
    , Points(surface.mesh.points)
    , Triangles(surface.mesh.triangles)
    , Largest(largest)
  {
  }

  void run()
  {
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      if (this->edgeToSplit(t) >= 0)
      {
        this->Needles.push_back(t);
      }
    }
    for (std::size_t t = 0; t < this->Triangles.size() && !this->Needles.empty(); ++t)
    {
      this->enterEdges(t);
    }
    while (!this->Needles.empty())
    {
      const std::size_t needle = this->Needles.back();
      this->Needles.pop_back();
      const int edge = this->edgeToSplit(needle);
      if (edge >= 0) // the split of a neighbour may have repaired it
      {
        this->split(needle, std::size_t(edge));
      }
    }
  }

private:
  /// Returns the longest edge of a triangle, or -1 if it is no needle.
  int edgeToSplit(std::size_t triangle) const
  {
    const auto& t = this->Triangles[triangle];
    int longest = 0;
    double squared[3];
    for (int i = 0; i < 3; ++i)
    {
      squared[i] =
        (this->Points[std::size_t(t[std::size_t((i + 1) % 3)])] - this->Points[std::size_t(t[std::size_t(i)])]).squaredNorm();
      longest = squared[i] > squared[longest] ? i : longest;
    }
    const double shortest = std::min({ squared[0], squared[1], squared[2] });
    return shortest > 0.0 && squared[longest] > this->Largest * shortest ? longest : -1;
  }

  static std::uint64_t key(std::int32_t from, std::int32_t to)
  {
    return std::uint64_t(std::uint32_t(from)) << 32 | std::uint32_t(to);
  }

  void enterEdges(std::size_t triangle)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->TriangleOf[key(this->Triangles[triangle][i], this->Triangles[triangle][(i + 1) % 3])] = triangle;
    }
  }

  /// Halves an edge of two triangles, each of which becomes two.
  void split(std::size_t needle, std::size_t edge)
  {
    const std::int32_t a = this->Triangles[needle][edge];
    const std::int32_t b = this->Triangles[needle][(edge + 1) % 3];
    const std::size_t neighbour = this->TriangleOf.at(key(b, a));
    const bool isBetweenCaps = this->Surface.isCap(this->Triangles[needle]) && this->Surface.isCap(this->Triangles[neighbour]);
    const auto facesOf = [this](std::int32_t point) { return this->Surface.faces[std::size_t(point)]; };
    if ((facesOf(a) & facesOf(b) & this->Surface.held) != 0 && !isBetweenCaps)
    {
      return; // a rim that has to stay
    }
    const auto middle = static_cast<std::int32_t>(this->Points.size());
    this->Points.push_back(0.5 * (this->Points[std::size_t(a)] + this->Points[std::size_t(b)]));
    this->Surface.faces.push_back(this->Surface.faces[std::size_t(a)] & this->Surface.faces[std::size_t(b)]);
    for (const std::size_t t : { needle, neighbour })
    {
      // The part at one end keeps its index, the other is new.
      auto other = this->Triangles[t];
      const std::int32_t from = t == needle ? a : b;
      const std::int32_t to = t == needle ? b : a;
      std::replace(this->Triangles[t].begin(), this->Triangles[t].end(), to, middle);
      std::replace(other.begin(), other.end(), from, middle);
      this->Triangles.push_back(other);
      for (const std::size_t part : { t, this->Triangles.size() - 1 })
      {
        this->enterEdges(part);
        this->Needles.push_back(part);
      }
    }
    this->TriangleOf.erase(key(a, b));
    this->TriangleOf.erase(key(b, a));
  }

  CappedSurface& Surface;
  std::vector<Eigen::Vector3d>& Points;
  std::vector<std::array<std::int32_t, 3>>& Triangles;
  double Largest;
  std::vector<std::size_t> Needles;                          ///< triangles to be checked
  std::unordered_map<std::uint64_t, std::size_t> TriangleOf; ///< per edge, in the direction of its triangle
};

} // namespace

void splitNeedles(CappedSurface& surface, double largest)
{
  NeedleSplitter(surface, largest).run();
}

} // namespace cactus
