// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cactus
{

/// What a number may be: from `lowest` to `highest`, both included, or `special`, which says "none" or "by default".
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
  /// Counting the special one.
  double smallest() const { return std::min(this->lowest, this->special.value_or(this->lowest)); }
};

/// Throws InvalidInput, "NAME is VALUE: give LOWEST to HIGHEST UNIT", for a number out of its range, infinite or NaN. `advice`
/// ends the message.
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

/// What is taken for a substrate, lengths in µm. Beyond these a value is a slip (a wrong unit, a broken file), and would cost
/// precision, memory or time without end rather than give a substrate. All readers and options refuse it by name; the
/// server-manager XML has the same numbers.
namespace limits
{

// What flows through the chain.

/// Of a fibre, at every control point, and as a target. Axons have 0.05 to 10, the giant axon of the squid 500.
inline constexpr Range radius{ 1e-3, 1e3, " µm" };
/// The same, where 0 stands for none.
inline constexpr Range radiusOrNone{ 1e-3, 1e3, " µm", 0.0 };
/// Of control points, of the domain's corners and of all that is derived from them, along each axis: 10 cm to either side. There
/// are then 7e4 steps of double precision in a nanometre.
inline constexpr Range coordinate{ -1e5, 1e5, " µm" };
/// Of a tractogram's points: a kilometre to either side of the scanner.
inline constexpr Range scannerCoordinate{ -1e6, 1e6, " mm" };
/// Of a domain along each axis.
inline constexpr Range side{ 0.1, 1e5, " µm" };
/// FibreId and BundleId, whole numbers.
inline constexpr Range id{ 1.0, 2147483647.0 };
/// Control points are counted in 32 bits, of which the neighbour search wants one.
inline constexpr double controlPoints = 2147483647.0;

// Options that several stages have.

/// What is kept between surfaces, and what they may move by.
inline constexpr Range gap{ 0.0, 10.0, " µm" };
/// The same where it is judged: -1 for what was promised.
inline constexpr Range judgedGap{ 0.0, 10.0, " µm", -1.0 };
inline constexpr Range surfaceTolerance{ 0.0, 1.0, " µm" };
inline constexpr Range seconds{ 0.0, 1e9, " s" };
/// As far as whole numbers go in ParaView.
inline constexpr Range seed{ 0.0, 2147483647.0 };
/// 0 for all that the machine offers, which is all that there can be (see Context::threadCount()).
inline constexpr Range threads{ 0.0, 65536.0 };
/// Of a volume that fibres fill.
inline constexpr Range fraction{ 1e-4, 0.999 };
/// The same, where 0 stands for none.
inline constexpr Range fractionOrNone{ 1e-4, 0.999, "", 0.0 };
/// Of all fibres, those whose surfaces are made.
inline constexpr Range sampledFraction{ 1e-4, 1.0 };

// BundleInitializer.

inline constexpr Range gammaShape{ 1e-2, 1e4 };
inline constexpr Range gammaScale{ 1e-5, 1e3, " µm" };
inline constexpr Range lognormalMean{ 1e-3, 1e3, " µm" };
inline constexpr Range lognormalDeviation{ 1e-6, 1e3, " µm" };
/// Of a published histogram: what is known of shrinkage, and much more.
inline constexpr Range histogramFactor{ 0.1, 10.0 };
/// 1 takes inner diameters as outer ones, 0 asks for a relation in place of a ratio.
inline constexpr Range histogramGRatio{ 0.1, 1.0, "", 0.0 };
/// The displacement of a fibre from face to face has to be more than rounding, and to be met within 2 %.
inline constexpr Range meanDispersion{ 1e-3, 45.0, "°", 0.0 };
inline constexpr Range correlationLength{ 1e-3, 1e5, " µm", 0.0 };
inline constexpr Range bundles{ 1.0, 2.0 };
inline constexpr Range crossingAngle{ 0.1, 90.0, "°" };
inline constexpr Range sheetThickness{ 1e-3, 1e5, " µm", 0.0 };
/// On each side of the domain.
inline constexpr Range bundleMargin{ 0.0, 1e4, " µm" };
inline constexpr Range spacingFactor{ 1e-2, 1e3 };
inline constexpr Range spacing{ 1e-2, 1e5, " µm" };

// TractFibres.

/// How many, 0 for all.
inline constexpr Range streamlines{ 0.0, 2147483647.0 };
/// Of a point in the unit of streamlines: the scanner's range in µm.
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
/// -1 for what the fibres were made for.
inline constexpr Range targetFraction{ 0.0, 0.999, "", -1.0 };
inline constexpr Range growthIterations{ 0.0, 1e3 };
inline constexpr Range surfaceRoughness{ 0.0, 0.5 };
inline constexpr Range imageMargin{ 0.0, 100.0, " µm" };

// MyelinSurface.

/// Of an axon's diameter to its fibre's.
inline constexpr Range gRatio{ 0.05, 0.99 };
/// Its standard deviation from fibre to fibre.
inline constexpr Range gRatioDeviation{ 0.0, 0.3 };
/// Passes blur by the square root of half their number, at most 3.2 voxels, and take on average passes · spacing² / (4 r) off a
/// round fibre of radius r: more than half the volume of the thinnest ones that are smoothed in full.
inline constexpr Range smoothingIterations{ 0.0, 20.0 };
/// Of VTK's windowed sinc filter, whose own advice is 10 to 20 iterations; a pass band of 2 lets everything through.
inline constexpr Range sincIterations{ 0.0, 500.0 };
inline constexpr Range sincPassBand{ 1e-4, 2.0 };
/// Part of the triangles that VTK's quadric decimation takes away.
inline constexpr Range targetReduction{ 0.0, 0.99 };

// FibreField.

/// A depth, in a fibre of any radius.
inline constexpr Range level{ 0.0, 1000.0, " µm" };

// SubstrateStatistics and SubstrateCertificate.

/// Between two cross-sections along a centre line: from a tenth of usual voxels.
inline constexpr Range cutSpacing{ 1e-2, 1e3, " µm" };
/// By how much a surface may reach out of the domain, as the rounding of a clip does.
inline constexpr Range clipTolerance{ 0.0, 1e5, " µm" };
/// Of one surface: 10 mm of the finest.
inline constexpr double cuts = 1e6;
inline constexpr Range bins{ 1.0, 1e4 };
/// Of a random walk.
inline constexpr Range walkers{ 1.0, 1e6, "", 0.0 };
inline constexpr Range walkDistance{ 0.1, 1e3, " µm" };
inline constexpr Range walkStep{ 1e-3, 10.0, " µm" };

} // namespace limits

} // namespace cactus
