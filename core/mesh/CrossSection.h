// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <utility>
#include <vector>

namespace cactus
{

/// Cuts one surface with many planes.
class CrossSections
{
public:
  /// Bins the triangles along the surface's longest axis. `mesh` has to outlive this object; its indices have to be valid.
  explicit CrossSections(const TriangleMesh& mesh);

  /// Returns the outline (µm, counter-clockwise seen against `normal`) of the surface around `point` in the plane through it with
  /// unit `normal`: the smallest closed loop that contains the point. Empty if the point lies outside the surface or the surface
  /// is open there. `reach` (µm, positive) is an estimate of the outline's extent; it only affects speed.
  std::vector<Eigen::Vector3d> outlineAround(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double reach) const;

private:
  std::size_t binOf(double coordinate) const;
  std::vector<Eigen::Vector3d> outlineWithin(
    const Eigen::Vector3d& point, const Eigen::Vector3d& normal, std::size_t firstBin, std::size_t lastBin) const;

  const TriangleMesh& Mesh;
  int Axis = 0;
  double Lower = 0.0;
  double Upper = 0.0;
  std::vector<std::size_t> Begin{ 0, 0 }; ///< per bin, where its triangles begin
  std::vector<std::size_t> Triangles;     ///< by bin
  std::vector<std::size_t> FirstBin;      ///< per triangle
};

/// Returns the area (µm²) of a plane polygon, positive if it runs counter-clockwise seen against unit `normal`.
double polygonArea(const std::vector<Eigen::Vector3d>& polygon, const Eigen::Vector3d& normal);

/// Returns the ratio of the minor to the major axis of the ellipse with the second moments of area of a plane polygon: 1 for
/// circles and all regular polygons. Precondition: a positive polygonArea().
double polygonAxisRatio(const std::vector<Eigen::Vector3d>& polygon, const Eigen::Vector3d& normal);

/// Returns the perimeter (µm) of a polygon.
double polygonPerimeter(const std::vector<Eigen::Vector3d>& polygon);

} // namespace cactus
