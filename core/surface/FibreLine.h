// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "fibres/Fibres.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace cactus
{

/// A place on a fibre's centre line.
struct LinePlace
{
  double along = 0.0;    ///< µm along the line, from its first control point
  double distance = 0.0; ///< µm, of the point for which it was found
};

/// The centre line of one fibre, and the places along it of points in the domain.
///
/// A place changes evenly from point to point: the plane across the line turns from each control point to the next. It lies on
/// the part of the line, or of one of its images where the domain is periodic, that is nearest to the point.
class FibreLine
{
public:
  FibreLine(const Fibres& fibres, std::size_t fibre);

  double length() const { return this->Along.back(); }
  /// Returns the distance (µm) along the line after which a fibre repeats; 0 if the domain is not periodic along z.
  double period() const { return this->Period; }
  /// Returns the position (µm) at a place, of the line itself and no image, and the unit vector along it.
  Eigen::Vector3d point(double along) const;
  Eigen::Vector3d direction(double along) const;

  /// Returns the part of the myelin's thickness that there is at a place.
  double myelinAt(double along) const;
  /// Tells whether that is less than 1 anywhere between two places.
  bool lacksMyelin(double from, double to) const;

  /// The parts of the line that are nearest to the points of a box.
  class Near
  {
  public:
    /// Returns the place of a point of the box.
    LinePlace at(const Eigen::Vector3d& point) const;

  private:
    friend class FibreLine;
    /// A segment from one control point to the next, shifted by whole periods.
    struct Segment
    {
      std::size_t first;
      Eigen::Vector3d shift;
    };
    const FibreLine* Line = nullptr;
    std::vector<Segment> Segments;
  };
  /// Returns them for a box of the domain (µm). The line has to outlive the result.
  Near near(const Eigen::AlignedBox3d& box) const;

private:
  std::size_t segmentAt(double along) const;
  /// Returns the part of a segment's length that ends at a place, 0 to 1.
  double partOf(std::size_t segment, double along) const;

  Domain Box;
  std::vector<Eigen::Vector3d> Points;
  std::vector<Eigen::Vector3d> Tangents; ///< unit vectors at the control points
  std::vector<double> Along;             ///< µm, of the control points
  std::vector<double> Myelin;            ///< fractions at the control points; empty: 1 everywhere
  double Period = 0.0;
};

} // namespace cactus
