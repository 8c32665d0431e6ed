// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "fibres/ColumnTable.h"

#include <Eigen/Core>

#include <cstddef>
#include <map>
#include <vector>

namespace cactus
{

/// Fibres as chains of capsules (paper, "Fibre capsule-parameterisation"): fibre f owns the control points
/// [offsets[f], offsets[f + 1]), and every two consecutive ones span a capsule. Lengths in µm.
struct Fibres
{
  std::vector<Eigen::Vector3d> points;   ///< control points
  std::vector<double> radii;             ///< outer radius at each control point
  std::vector<double> myelinFractions;   ///< part of the myelin's thickness at each control point, 0 to 1; empty: 1 everywhere
  std::vector<std::size_t> offsets{ 0 }; ///< size() + 1 entries, increasing
  std::vector<int> fibreIds;             ///< one per fibre, positive and unique
  std::vector<int> bundleIds;            ///< one per fibre, positive
  std::vector<double> targetRadii;       ///< sampled outer radius, one per fibre
  ColumnTable columns;                   ///< what else is known of each fibre, see fibreColumns()
  Domain domain;
  /// Fraction of the domain that the fibres are to fill once growth has brought them to their target radii; 0 if unknown.
  double grownFraction = 0.0;
  /// Coefficients of the distribution of directions that the fibres were made for, in real spherical harmonics of the degrees up
  /// to 8 (see base/SphericalHarmonics.h); their integral over the sphere is the fraction filled before growth. Empty if unknown.
  std::vector<double> orientationHarmonics;

  std::size_t size() const { return offsets.size() - 1; }
  std::size_t pointCount(std::size_t fibre) const { return offsets[fibre + 1] - offsets[fibre]; }
  /// Appends an empty fibre; follow it with addPoint for its control points.
  void addFibre(int fibreId, int bundleId, double targetRadius);
  /// Appends an empty fibre with everything that is known of one of `from`; follow it with addPoint or addPoints.
  void addFibre(const Fibres& from, std::size_t fibre);
  /// Appends a control point to the last fibre.
  void addPoint(const Eigen::Vector3d& point, double radius);
  /// Sets the myelin fraction of the last control point.
  void setMyelinFraction(double fraction);
  /// Appends the control points [first, last) of `from` to the last fibre.
  void addPoints(const Fibres& from, std::size_t first, std::size_t last);
  /// Returns fibres with the same domain, grown fraction and harmonics, and no fibre yet.
  Fibres emptyCopy() const;
};

/// How a fibre of a domain that is periodic along z repeats: control point i + `points` is control point i, shifted. The fibre
/// has at least one period, and the same again beyond.
struct FibrePeriod
{
  std::size_t points = 0;                          ///< control points in one period
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(); ///< µm, by whole periods
};

/// Finds the period of a fibre. Throws InvalidInput, naming the fibre, if it does not repeat.
FibrePeriod periodOf(const Fibres& fibres, std::size_t f);

/// Throws InvalidInput unless the domain has corners and sides within the limits (see Limits.h), and is periodic along no axis, x
/// and y, or all.
void validate(const Domain& domain);

/// Throws InvalidInput, naming the fibre, unless: there is a fibre; every fibre has at least two control points, no
/// zero-length segment, and coordinates, radii, target radius and columns within the limits (see Limits.h, ColumnTable.h); ids
/// are positive and fibre ids unique; the domain is valid, and fibres repeat along z if that does.
void validate(const Fibres& fibres);

/// Tells whether the myelin fraction of one of a fibre's control points is less than 1.
bool lacksMyelin(const Fibres& fibres, std::size_t fibre);

/// Tells whether the fibre is an axon without myelin.
bool isBare(const Fibres& fibres, std::size_t fibre);

/// Returns the root mean square of the radii at a fibre's control points (µm), the fibre's target radius where nothing else says
/// it: the volume of a fibre goes with it. NaN for a fibre without a control point.
double rootMeanSquareRadius(const Fibres& fibres, std::size_t fibre);

/// Volume (µm³) of one fibre: its capsules as truncated cones between control points, without end caps.
double chainVolume(const Fibres& fibres, std::size_t fibre);

/// Volume (µm³) of the union-free sum of the fibres' capsules inside the domain, each chain measured as truncated cones
/// between control points clipped to the domain along the centre line. Overlaps count twice, end caps are left out.
double capsuleVolumeInDomain(const Fibres& fibres);

/// Returns the part of it that one fibre has.
double capsuleVolumeInDomain(const Fibres& fibres, std::size_t fibre);

/// Returns the volume (µm³) that the fibres have in the domain if each has its target radius, measured in the same way.
double targetVolumeInDomain(const Fibres& fibres);

/// Returns the angle (degrees, at most 90) between two lines of these directions, which need not be unit vectors.
double angleBetweenLines(const Eigen::Vector3d& direction, const Eigen::Vector3d& axis);

/// Mean angle (degrees) between each fibre's end-to-end direction and its bundle's axis, where an axis is the normalised sum
/// of the end-to-end unit directions of the bundle's fibres. `bundleId` 0 averages over all bundles' fibres.
double meanDispersion(const Fibres& fibres, int bundleId = 0);

/// Returns the same for the directions of all segments, weighted by their length.
double meanTangentDispersion(const Fibres& fibres, int bundleId = 0);

/// Returns the axes (unit vectors) of all bundles, by BundleId: the normalised sum of a bundle's end-to-end unit directions, each
/// reversed if it points against the first fibre's; +z if every fibre ends where it begins.
std::map<int, Eigen::Vector3d> bundleAxes(const Fibres& fibres);

} // namespace cactus
