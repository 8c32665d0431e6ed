// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/EditableSurface.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace cactus
{

/// How far the field is out of its range at some points, and the moves that would bring it back.
struct FieldFit
{
  double excess = 0.0; ///< excess at the worst point, 0 or more
  /// A move of the point between these (µm, outwards) brings the field into its range everywhere, as far as the field is linear;
  /// if the lower one is larger, no move does.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();

  bool isOut() const { return this->excess > 0.0; }
  bool canBeMoved() const { return this->lower <= this->upper; }
};

/// The excess of the field over its range in a triangle, µm, 0 within the range.
struct TriangleExcess
{
  std::array<float, 3> inMiddles; ///< of edges, the one behind each corner
  float inCentroid;
};

/// Keeps a surface where a field, which rises by about 1 per µm into the body, is within an error of a level. On faces of the box
/// the field may be larger.
class FieldBounds
{
public:
  using Field = std::function<double(const Eigen::Vector3d&)>;

  /// Checks large triangles at points at most `sampling` (µm) apart. All arguments passed by reference have to outlive the
  /// object.
  FieldBounds(const EditableSurface& surface, const Field& field, double level, double error, double sampling)
    : Surface(surface)
    , Value(field)
    , Level(level)
    , Smallest(level - error)
    , Largest(level + error)
    , Sampling(sampling)
  {
  }

  /// Returns the excess of the field over its range at a place (µm, 0 or more); the bits of `faces` are the faces of the box that
  /// contain it.
  double excessAt(const Eigen::Vector3d& place, std::uint8_t faces) const
  {
    const double value = this->Value(place);
    return std::max({ 0.0, this->Smallest - value, faces == 0 ? value - this->Largest : 0.0 });
  }
  TriangleExcess excessOf(const std::array<std::int32_t, 3>& triangle) const;

  /// Returns the fit at u and v when both move to `place`, and in the middles of edges and the centroids of the triangles that
  /// remain at them. It stops and returns the fit once `isEnough(fit so far)` is true.
  template <typename IsEnough>
  FieldFit fitAfterCollapse(std::int32_t u, std::int32_t v, const Eigen::Vector3d& place, IsEnough&& isEnough) const;

  /// Tells whether the field is in its range along an edge at points at most `sampling` apart, except its middle.
  bool holdAlong(const Eigen::Vector3d& a, const Eigen::Vector3d& b, std::uint8_t faces) const;
  /// Tells the same for the points between the edges of a triangle, if it is wide.
  bool holdWithin(const std::array<Eigen::Vector3d, 3>& corners, std::uint8_t faces) const;
  /// Tells both for all triangles that remain at u and v when these move to `place`; edges that do not change are skipped.
  bool holdAfterCollapse(std::int32_t u, std::int32_t v, const Eigen::Vector3d& place) const;

  /// Returns the largest distance of the field from its level in the middle of the edge a b and of the triangles that it makes
  /// with c and d, or the first one found above `limit`.
  double largestError(
    const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d, double limit) const;

private:
  /// Adds a point that moves by `weight` when the corner moves by 1.
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
