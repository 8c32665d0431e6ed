// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cactus
{

/// The values that a number may have: from `lowest` to `highest`, both included, or `special`, which means "none" or "by
/// default".
struct Range
{
  double lowest;
  double highest;
  const char* unit = ""; ///< with a blank before it: " µm"
  std::optional<double> special = {};

  bool holds(double value) const
  {
    return std::isfinite(value) && ((value >= this->lowest && value <= this->highest) || value == this->special);
  }
  /// Includes `special`.
  double smallest() const { return std::min(this->lowest, this->special.value_or(this->lowest)); }
};

/// Throws InvalidInput, "NAME is VALUE: give LOWEST to HIGHEST UNIT", for a number that is out of range, infinite or NaN.
/// `advice` ends the message.
inline void requireWithin(const char* name, double value, const Range& range, const char* advice = "")
{
  if (range.holds(value))
  {
    return;
  }
  TextStream message;
  message.precision(10); // as many as the largest whole numbers have
  message << name << " is " << value << ": give ";
  if (range.special)
  {
    message << *range.special << " or ";
  }
  message << range.lowest << " to " << range.highest << range.unit << advice;
  throw InvalidInput(message.str());
}

/// The accepted values, lengths in µm. A value beyond these is a mistake (a wrong unit, a broken file) and would only cost
/// precision, memory or time. All readers and options refuse it by name; the server-manager XML has the same numbers.
namespace limits
{

// What flows through the chain.

/// A fibre's radius, at every control point and as a target. Axons have 0.05 to 10, the giant axon of the squid 500.
inline constexpr Range radius{ 1e-3, 1e3, " µm" };
/// The same, with 0 for none.
inline constexpr Range radiusOrNone{ 1e-3, 1e3, " µm", 0.0 };
/// Axons without myelin: their part of the domain, radius, its deviation and the size of their clusters.
inline constexpr Range unmyelinatedFraction{ 0.0, 0.6 };
inline constexpr Range unmyelinatedRadius{ 0.01, 2.0, " µm" };
inline constexpr Range unmyelinatedDeviation{ 0.0, 1.0, " µm" };
inline constexpr Range unmyelinatedCluster{ 1.0, 1000.0 };
/// Coordinates of control points, of the domain's corners and of all that is derived from them, along each axis: 10 cm to either
/// side. Double precision then still has 7e4 steps in a nanometre.
inline constexpr Range coordinate{ -1e5, 1e5, " µm" };
/// Coordinates of a tractogram's points: a kilometre to either side of the scanner.
inline constexpr Range scannerCoordinate{ -1e6, 1e6, " mm" };
/// The domain's size along each axis.
inline constexpr Range side{ 0.1, 1e5, " µm" };
/// The same, where 0 stands for a cube.
inline constexpr Range length{ side.lowest, side.highest, " µm", 0.0 };
/// FibreId and BundleId, whole numbers.
inline constexpr Range id{ 1.0, 2147483647.0 };
inline constexpr Range idOrFirst{ 0.0, 2147483647.0 };
/// The largest number of control points: they are counted in 32 bits, of which the neighbour search needs one.
inline constexpr double controlPoints = 2147483647.0;

// Options that several stages have.

/// The distance kept between surfaces, and how far they may move.
inline constexpr Range gap{ 0.0, 10.0, " µm" };
/// The same as a criterion: -1 for the gap that was promised.
inline constexpr Range judgedGap{ 0.0, 10.0, " µm", -1.0 };
inline constexpr Range surfaceTolerance{ 0.0, 1.0, " µm" };
inline constexpr Range seconds{ 0.0, 1e9, " s" };
/// The largest is ParaView's largest whole number.
inline constexpr Range seed{ 0.0, 2147483647.0 };
/// 0 for all processors, which is also the effective maximum (see Context::threadCount()).
inline constexpr Range threads{ 0.0, 65536.0 };
/// A volume fraction of fibres.
inline constexpr Range fraction{ 1e-4, 0.999 };
/// The same, where 0 stands for none.
inline constexpr Range fractionOrNone{ 1e-4, 0.999, "", 0.0 };
/// The part of all fibres whose surfaces are made.
inline constexpr Range sampledFraction{ 1e-4, 1.0 };

// BundleInitializer.

inline constexpr Range gammaShape{ 1e-2, 1e4 };
inline constexpr Range gammaScale{ 1e-5, 1e3, " µm" };
inline constexpr Range lognormalMean{ 1e-3, 1e3, " µm" };
inline constexpr Range lognormalDeviation{ 1e-6, 1e3, " µm" };
/// Factor on the diameters of a published histogram: wider than known shrinkage.
inline constexpr Range histogramFactor{ 0.1, 10.0 };
/// 1 takes inner diameters as outer ones, 0 asks for a relation in place of a ratio.
inline constexpr Range histogramGRatio{ 0.1, 1.0, "", 0.0 };
/// Below the lowest value, a fibre's displacement from face to face would be only rounding; it has to be met within 2 %.
inline constexpr Range meanDispersion{ 1e-3, 45.0, "°", 0.0 };
inline constexpr Range sinuosity{ 1.0, 1.3 };
inline constexpr Range undulationWavelength{ 5.0, 200.0, " µm" };
inline constexpr Range correlationLength{ 1e-3, 1e5, " µm", 0.0 };
inline constexpr Range bundles{ 1.0, 2.0 };
/// A vector shorter than this has no direction.
inline constexpr double shortestDirection = 1e-9;
inline constexpr Range crossingAngle{ 0.1, 90.0, "°" };
inline constexpr Range sheetThickness{ 1e-3, 1e5, " µm", 0.0 };
/// The margin on each side of the domain.
inline constexpr Range bundleMargin{ 0.0, 1e4, " µm" };
/// -1: as much as is needed.
inline constexpr Range bundleMarginOrAsNeeded{ bundleMargin.lowest, bundleMargin.highest, " µm", -1.0 };
/// Deviation of the logarithm of an axon's radius along it, and the length over which it is correlated.
inline constexpr Range calibreVariation{ 1e-3, 0.5, "", 0.0 };
inline constexpr Range calibreCorrelationLength{ 0.3, 20.0, " µm" };
inline constexpr Range beadAmplitude{ 1e-3, 3.0, "", 0.0 };
inline constexpr Range beadSpacing{ 0.5, 50.0, " µm" };
inline constexpr Range beadSpacingDeviation{ 0.0, 50.0, " µm" };
inline constexpr Range beadLength{ 0.3, 10.0, " µm" };
inline constexpr Range spacingFactor{ 1e-2, 1e3 };
inline constexpr Range spacing{ 1e-2, 1e5, " µm" };

// TractFibres.

/// How many streamlines are used; 0 for all.
inline constexpr Range streamlines{ 0.0, 2147483647.0 };
/// Coordinates of a streamline's point, in the streamlines' unit: the scanner's range in µm.
inline constexpr Range streamlineCoordinate{ -1e9, 1e9 };
inline constexpr Range scaleFactor{ 1e-6, 1e3 };
inline constexpr Range bundleDiameter{ 1e-2, 1e5, " µm", 0.0 };

// CapsuleOptimizer.

inline constexpr Range iterations{ 0.0, 1e7 };
inline constexpr Range historyInterval{ 1.0, 1e7 };
inline constexpr Range overlapTolerance{ 1e-9, 0.5 };
inline constexpr Range overlapWeight{ 1e-6, 1e6 };
inline constexpr Range weight{ 0.0, 1e6 };
inline constexpr Range stepSize{ 1e-6, 10.0 };
inline constexpr Range momentum{ 0.0, 0.999 };
inline constexpr Range safetyMargin{ 1.0, 1.2 };
inline constexpr Range radiusTolerance{ 0.0, 0.5 };
inline constexpr Range relaxation{ 0.5, 1.0 };
inline constexpr Range packingLimit{ 0.1, 1.0 };

// FibreRadialGrowth.

inline constexpr Range voxelSize{ 1e-3, 10.0, " µm" };
/// -1 for the fraction that the fibres were made for.
inline constexpr Range targetFraction{ 0.0, 0.999, "", -1.0 };
inline constexpr Range growthIterations{ 0.0, 1e3 };
inline constexpr Range surfaceRoughness{ 0.0, 0.5 };
/// Points per µm³; 0: capsules.
inline constexpr Range seedDensity{ 0.1, 1000.0, " per µm³", 0.0 };
inline constexpr Range sectionAxisRatio{ 0.7, 1.0 };
inline constexpr Range imageMargin{ 0.0, 100.0, " µm" };

// Lesion.

inline constexpr Range axonLoss{ 0.0, 0.95 };
/// A part of myelin or of internodes.
inline constexpr Range part{ 0.0, 1.0 };

// MyelinSurface.

/// Ratio of an axon's diameter to its fibre's.
inline constexpr Range gRatio{ 0.05, 0.99 };
/// The same, where 0 stands for none given.
inline constexpr Range gRatioOrNone{ gRatio.lowest, gRatio.highest, "", 0.0 };
/// The same of a single fibre, which may have no myelin (1).
inline constexpr Range gRatioOrBare{ gRatio.lowest, 1.0 };
/// Its standard deviation from fibre to fibre.
inline constexpr Range gRatioDeviation{ 0.0, 0.3 };
/// Smoothing passes. They blur by the square root of half their number, at most 3.2 voxels, and take on average passes · spacing²
/// / (4 r) off a round fibre of radius r: more than half the volume of the thinnest fibres that are smoothed in full.
inline constexpr Range smoothingIterations{ 0.0, 20.0 };
/// Iterations of VTK's windowed sinc filter, which itself advises 10 to 20; a pass band of 2 lets everything through.
inline constexpr Range sincIterations{ 0.0, 500.0 };
inline constexpr Range sincPassBand{ 1e-4, 2.0 };
/// The fraction of the triangles that VTK's quadric decimation removes.
inline constexpr Range targetReduction{ 0.0, 0.99 };

// FibreField.

/// A depth inside a fibre of any radius.
inline constexpr Range level{ 0.0, 1000.0, " µm" };

// SubstrateStatistics and SubstrateCertificate.

/// The distance between two cross-sections along a centre line: from a tenth of a usual voxel.
inline constexpr Range cutSpacing{ 1e-2, 1e3, " µm" };
/// How far a surface may reach out of the domain, as after the rounding of a clip.
inline constexpr Range clipTolerance{ 0.0, 1e5, " µm" };
/// The largest number of cross-sections of one surface: 10 mm at the finest spacing.
inline constexpr double cuts = 1e6;
inline constexpr Range bins{ 1.0, 1e4 };
/// The number of walkers of a random walk.
inline constexpr Range walkers{ 1.0, 1e6, "", 0.0 };
inline constexpr Range walkDistance{ 0.1, 1e3, " µm" };
inline constexpr Range walkStep{ 1e-3, 10.0, " µm" };

} // namespace limits

} // namespace cactus
