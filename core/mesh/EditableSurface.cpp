// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/EditableSurface.h"

#include <Eigen/Geometry>

#include <stdexcept>
#include <utility>

namespace cactus
{

EditableSurface::EditableSurface(CappedSurface& surface)
  : Surface(surface)
  , Normals(surface.mesh.triangles.size())
  , First(surface.mesh.points.size(), -1)
  , Next(3 * surface.mesh.triangles.size())
  , Mark(surface.mesh.points.size(), 0)
  , Alive(surface.mesh.triangles.size())
{
  this->locate();
  for (std::size_t t = surface.mesh.triangles.size(); t-- > 0;)
  {
    this->link(t);
    this->findNormal(t);
  }
}

void EditableSurface::findNormal(std::size_t triangle)
{
  const auto& corners = this->cornersOf(triangle);
  const Eigen::Vector3d& a = this->at(corners[0]);
  this->Normals[triangle] = (this->at(corners[1]) - a).cross(this->at(corners[2]) - a);
}

void EditableSurface::findNormalsAt(std::int32_t point)
{
  for (std::int32_t c = this->firstCorner(point); c >= 0; c = this->nextCorner(c))
  {
    this->findNormal(std::size_t(c) / 3);
  }
}

void EditableSurface::move(std::int32_t point, const Eigen::Vector3d& place)
{
  this->Points[point] = place;
  this->findNormalsAt(point);
}

void EditableSurface::locate()
{
  this->Points = this->Surface.mesh.points.data();
  this->Triangles = this->Surface.mesh.triangles.data();
  this->Faces = this->Surface.faces.data();
}

void EditableSurface::link(std::size_t triangle)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    auto& first = this->First[std::size_t(this->cornersOf(triangle)[i])];
    this->Next[3 * triangle + i] = first;
    first = static_cast<std::int32_t>(3 * triangle + i);
  }
}

void EditableSurface::unlink(std::int32_t point, std::int32_t corner)
{
  std::int32_t* link = &this->First[std::size_t(point)];
  while (*link != corner)
  {
    link = &this->Next[std::size_t(*link)];
  }
  *link = this->Next[std::size_t(corner)];
}

void EditableSurface::unlink(std::size_t triangle)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    this->unlink(this->cornersOf(triangle)[i], static_cast<std::int32_t>(3 * triangle + i));
  }
}

bool EditableSurface::areLinked(std::int32_t u, std::int32_t v) const
{
  for (std::int32_t c = this->firstCorner(u); c >= 0; c = this->nextCorner(c))
  {
    const auto& corners = this->cornersOf(std::size_t(c) / 3);
    if (corners[0] == v || corners[1] == v || corners[2] == v)
    {
      return true;
    }
  }
  return false;
}

int EditableSurface::valence(std::int32_t point) const
{
  int count = 0;
  for (std::int32_t c = this->firstCorner(point); c >= 0; c = this->nextCorner(c))
  {
    ++count;
  }
  return count;
}

std::size_t EditableSurface::triangleAlong(std::int32_t from, std::int32_t to) const
{
  for (std::int32_t c = this->firstCorner(from); c >= 0; c = this->nextCorner(c))
  {
    if (this->oppositeEdge(c)[0] == to)
    {
      return std::size_t(c) / 3;
    }
  }
  throw std::logic_error("a surface is open, so that it cannot be edited");
}

std::int32_t EditableSurface::thirdCorner(std::size_t triangle, std::int32_t a, std::int32_t b) const
{
  const auto& corners = this->cornersOf(triangle);
  return corners[0] != a && corners[0] != b ? corners[0] : corners[1] != a && corners[1] != b ? corners[1] : corners[2];
}

bool EditableSurface::isCollapsible(std::int32_t u, std::int32_t v)
{
  this->MarkValue += 2;
  int around = 0;
  for (std::int32_t c = this->firstCorner(u); c >= 0; c = this->nextCorner(c))
  {
    for (const std::int32_t corner : this->cornersOf(std::size_t(c) / 3))
    {
      this->Mark[std::size_t(corner)] = this->MarkValue;
    }
    ++around;
  }
  int common = 0;
  int aroundV = 0;
  for (std::int32_t c = this->firstCorner(v); c >= 0; c = this->nextCorner(c))
  {
    for (const std::int32_t corner : this->cornersOf(std::size_t(c) / 3))
    {
      auto& mark = this->Mark[std::size_t(corner)];
      if (corner != u && corner != v && mark == this->MarkValue)
      {
        ++common;
        mark = this->MarkValue + 1;
      }
    }
    ++aroundV;
  }
  return common == 2 && around + aroundV > 6;
}

void EditableSurface::collapse(std::int32_t u, std::int32_t v, const Eigen::Vector3d& place)
{
  this->Points[u] = place;
  this->Faces[u] |= this->facesOf(v);
  // The triangles on the edge die; v's others move to u.
  for (std::int32_t c = this->firstCorner(v); c >= 0;)
  {
    const std::int32_t next = this->nextCorner(c);
    const auto t = std::size_t(c) / 3;
    auto& corners = this->Triangles[t];
    if (corners[0] == u || corners[1] == u || corners[2] == u)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        if (corners[i] != v)
        {
          this->unlink(corners[i], static_cast<std::int32_t>(3 * t + i));
        }
      }
      corners = { { -1, -1, -1 } };
      --this->Alive;
    }
    else
    {
      corners[std::size_t(c) % 3] = u;
      this->Next[std::size_t(c)] = this->First[std::size_t(u)];
      this->First[std::size_t(u)] = c;
    }
    c = next;
  }
  this->First[std::size_t(v)] = -1;
  this->findNormalsAt(u);
}

void EditableSurface::flip(std::size_t one, std::size_t other, std::int32_t a, std::int32_t b)
{
  const std::int32_t c = this->thirdCorner(one, a, b);
  const std::int32_t d = this->thirdCorner(other, a, b);
  this->unlink(one);
  this->unlink(other);
  this->Triangles[one] = { { a, d, c } };
  this->Triangles[other] = { { d, b, c } };
  for (const std::size_t triangle : { one, other })
  {
    this->link(triangle);
    this->findNormal(triangle);
  }
}

bool EditableSurface::isHeldRim(std::int32_t point) const
{
  if (!this->Surface.isHeld(point))
  {
    return false;
  }
  for (std::int32_t c = this->firstCorner(point); c >= 0; c = this->nextCorner(c))
  {
    if (!this->isCap(this->cornersOf(std::size_t(c) / 3)))
    {
      return true;
    }
  }
  return false;
}

bool EditableSurface::isHeldRim(std::int32_t a, std::int32_t b) const
{
  return (this->facesOf(a) & this->facesOf(b) & this->Surface.held) != 0 &&
         !(this->isCap(this->cornersOf(this->triangleAlong(a, b))) && this->isCap(this->cornersOf(this->triangleAlong(b, a))));
}

std::int32_t EditableSurface::addPoint(const Eigen::Vector3d& place, std::uint8_t faces)
{
  const auto point = static_cast<std::int32_t>(this->pointCount());
  this->Surface.mesh.points.push_back(place);
  this->Surface.faces.push_back(faces);
  this->locate();
  this->First.push_back(-1);
  this->Mark.push_back(0);
  return point;
}

/// It is not linked yet.
std::size_t EditableSurface::addTriangle(const std::array<std::int32_t, 3>& corners)
{
  this->Surface.mesh.triangles.push_back(corners);
  this->locate();
  this->Next.resize(this->Next.size() + 3);
  this->Normals.emplace_back();
  ++this->Alive;
  return this->triangleCount() - 1;
}

std::int32_t EditableSurface::split(std::int32_t a, std::int32_t b, const Eigen::Vector3d& place)
{
  const std::size_t halved[2] = { this->triangleAlong(a, b), this->triangleAlong(b, a) };
  const std::int32_t middle = this->addPoint(place, this->facesOf(a) & this->facesOf(b));
  for (const std::size_t triangle : halved)
  {
    // The half at b keeps its index, the half at a is new.
    auto half = this->cornersOf(triangle);
    this->unlink(triangle);
    for (std::size_t i = 0; i < 3; ++i)
    {
      auto& corner = this->Triangles[triangle][i];
      corner = corner == a ? middle : corner;
      half[i] = half[i] == b ? middle : half[i];
    }
    for (const std::size_t t : { triangle, this->addTriangle(half) })
    {
      this->link(t);
      this->findNormal(t);
    }
  }
  return middle;
}

std::int32_t EditableSurface::fan(
  const std::vector<std::size_t>& disc, const std::vector<std::int32_t>& loop, const Eigen::Vector3d& place)
{
  std::uint8_t faces = 0xff;
  for (const std::int32_t point : loop)
  {
    faces &= this->facesOf(point);
  }
  for (const std::size_t triangle : disc)
  {
    this->unlink(triangle);
    this->Triangles[triangle] = { { -1, -1, -1 } };
  }
  this->Alive -= disc.size();
  const std::int32_t centre = this->addPoint(place, faces);
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    const std::array<std::int32_t, 3> corners{ { loop[i], loop[(i + 1) % loop.size()], centre } };
    const std::size_t triangle = i < disc.size() ? disc[i] : this->addTriangle(corners);
    if (i < disc.size())
    {
      this->Triangles[triangle] = corners;
      ++this->Alive;
    }
    this->link(triangle);
    this->findNormal(triangle);
  }
  return centre;
}

void EditableSurface::compact()
{
  auto& triangles = this->Surface.mesh.triangles;
  std::vector<std::int32_t> number(this->pointCount(), -1);
  std::size_t alive = 0;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint8_t> faces;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    if (this->isDead(t))
    {
      continue;
    }
    auto corners = triangles[t];
    for (std::int32_t& corner : corners)
    {
      auto& n = number[std::size_t(corner)];
      if (n < 0)
      {
        n = static_cast<std::int32_t>(points.size());
        points.push_back(this->at(corner));
        faces.push_back(this->facesOf(corner));
      }
      corner = n;
    }
    triangles[alive++] = corners;
  }
  triangles.resize(alive);
  this->Surface.mesh.points = std::move(points);
  this->Surface.faces = std::move(faces);
}

} // namespace cactus
