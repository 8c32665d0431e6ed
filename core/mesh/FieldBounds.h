// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/EditableSurface.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace cactus
{

/// By how much the field is out of its range at some points, and how far these would have to move to bring it back.
struct FieldFit
{
  double excess = 0.0; ///< by how much it is out of its range at the worst point, 0 or more
  /// Between these (µm, outwards) a point may move to bring the field into its range everywhere, as far as the field changes
  /// linearly; the lower one is larger where no move does.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();

  bool isOut() const { return this->excess > 0.0; }
  bool canBeMoved() const { return this->lower <= this->upper; }
};

/// Keeps a surface where a field, which rises by about 1 per µm into the body, is within an error of a level. On faces of the box
/// the field may be larger.
class FieldBounds
{
public:
  using Field = std::function<double(const Eigen::Vector3d&)>;

  /// Large triangles are looked at in points at most `sampling` (µm) apart. What is given by reference has to outlive the object.
  FieldBounds(const EditableSurface& surface, const Field& field, double level, double error, double sampling)
    : Surface(surface)
    , Value(field)
    , Level(level)
    , Smallest(level - error)
    , Largest(level + error)
    , Sampling(sampling)
  {
  }

  /// The fit at u and v and at the middles of edges and the centroids of the triangles at them. Once `isEnough(fit so far)` is
  /// true, that is what is returned.
  template <typename IsEnough>
  FieldFit fitAround(std::int32_t u, std::int32_t v, IsEnough&& isEnough) const;
  /// The same of the triangles that are left when u and v move to `place`.
  template <typename IsEnough>
  FieldFit fitAfterCollapse(std::int32_t u, std::int32_t v, const Eigen::Vector3d& place, IsEnough&& isEnough) const;

  /// Whether the field is in its range at the points of a triangle that fits look at: corners, middles of edges and centroid.
  bool holdAt(const std::array<std::int32_t, 3>& triangle) const;

  /// Whether the field is in its range all over a triangle, at points at most `sampling` apart besides those of the fits. A bit
  /// of `faces` says that a corner is on that face of the box.
  bool holdWithin(const std::array<Eigen::Vector3d, 3>& corners, const std::array<std::uint8_t, 3>& faces) const;
  /// The same for all triangles that are left at u and v when these move to `place`.
  bool holdAfterCollapse(std::int32_t u, std::int32_t v, const Eigen::Vector3d& place) const;

  /// The largest distance of the field from its level in the middle of the edge a b and of the triangles that it makes with c and
  /// d, or the first one found that is above `limit`.
  double largestError(
    const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d, double limit) const;

private:
  /// Adds a point that moves by `weight` where the corner moves by 1.
  void add(FieldFit& fit, const Eigen::Vector3d& p, std::uint8_t faces, double weight) const
  {
    const double value = this->Value(p);
    const double below = this->Smallest - value;
    fit.excess = std::max(fit.excess, below);
    fit.upper = std::min(fit.upper, -below / weight);
    if (faces == 0)
    {
      const double above = value - this->Largest;
      fit.excess = std::max(fit.excess, above);
      fit.lower = std::max(fit.lower, above / weight);
    }
  }

  /// Adds the middle of one edge at a corner `a` of a triangle, and the triangle's centroid.
  void addTriangle(FieldFit& fit, const Eigen::Vector3d& a, std::uint8_t faces, const std::array<std::int32_t, 2>& edge) const
  {
    const Eigen::Vector3d& b = this->Surface.at(edge[0]);
    const Eigen::Vector3d& d = this->Surface.at(edge[1]);
    const std::uint8_t facesOfEdge = faces & this->Surface.facesOf(edge[0]);
    const std::uint8_t facesOfAll = facesOfEdge & this->Surface.facesOf(edge[1]);
    this->add(fit, 0.5 * (a + b), facesOfEdge, 1.0 / 2.0);
    this->add(fit, (a + b + d) / 3.0, facesOfAll, 1.0 / 3.0);
  }

  const EditableSurface& Surface;
  const Field& Value;
  double Level;
  double Smallest;
  double Largest;
  double Sampling;
};

template <typename IsEnough>
FieldFit FieldBounds::fitAround(std::int32_t u, std::int32_t v, IsEnough&& isEnough) const
{
  FieldFit fit;
  for (const std::int32_t point : { u, v })
  {
    const std::uint8_t faces = this->Surface.facesOf(point);
    this->add(fit, this->Surface.at(point), faces, 1.0);
    for (std::int32_t c = this->Surface.firstCorner(point); c >= 0; c = this->Surface.nextCorner(c))
    {
      this->addTriangle(fit, this->Surface.at(point), faces, this->Surface.oppositeEdge(c));
      if (isEnough(fit))
      {
        return fit;
      }
    }
  }
  return fit;
}

template <typename IsEnough>
FieldFit FieldBounds::fitAfterCollapse(std::int32_t u, std::int32_t v, const Eigen::Vector3d& place, IsEnough&& isEnough) const
{
  FieldFit fit;
  const std::uint8_t faces = this->Surface.facesOf(u) | this->Surface.facesOf(v);
  this->add(fit, place, faces, 1.0);
  this->Surface.visitCornersAt(u, v,
    [&](std::int32_t c, std::int32_t)
    {
      const std::array<std::int32_t, 2> edge = this->Surface.oppositeEdge(c);
      if (!EditableSurface::outlivesCollapse(edge, u, v))
      {
        return false;
      }
      this->addTriangle(fit, place, faces, edge);
      return isEnough(fit);
    });
  return fit;
}

} // namespace cactus
