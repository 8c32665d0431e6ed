// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace cactus
{

/// Options of a fibre's seed.
struct SeedOptions
{
  /// How far, as a fraction of the local radius, the seeded shape may fall short of the capsule: 0 seeds the capsule itself,
  /// larger values make the calibre uneven. In [0, 0.5].
  double surfaceRoughness = 0.0;
  std::uint64_t seed = 1;
  /// Fraction of the domain that the fibres are grown to, see SectionShape; 0 if it is not known.
  double grownFraction = 0.0;
  /// Random points per µm³ of the capsules from which fibres grow, see SeedPoints; 0: the capsules themselves are the seed.
  double pointDensity = 0.0;
};

/// A fibre's thickness along its axis: the radius of its seed, as a fraction of that of its capsules, at each length from its
/// first control point. Other variations of calibre (beading) belong here: callers use only these fractions and the longest
/// piece.
///
/// The fraction is 1 - ρ u(l) with ρ the SurfaceRoughness and u a smooth random function from 0 to 1: a cubic B-spline over the
/// length l whose coefficients follow the arcsine distribution, so that most are near 0 or 1. It depends only on seed, fibre id
/// and length.
class Calibre
{
public:
  /// Checks the options; throws InvalidInput if one is out of range.
  explicit Calibre(const SeedOptions& options);

  /// Tells whether the fraction differs from 1 anywhere.
  bool varies() const { return this->Options.surfaceRoughness > 0.0; }

  /// Returns a lower bound of the fraction.
  double smallestFraction() const { return 1.0 - this->Options.surfaceRoughness; }

  /// Returns the length (µm) of a piece along which the radius may be taken to vary linearly between its ends; infinite for a
  /// calibre that does not vary.
  double longestPiece() const;

private:
  friend class FibreCalibre;

  SeedOptions Options;
};

/// The calibre of one fibre. It keeps the random numbers that nearby lengths share; this changes no bit.
class FibreCalibre
{
public:
  /// Makes the calibre of a fibre. `calibre` must outlive this object.
  FibreCalibre(const Calibre& calibre, int fibreId);

  /// Returns the fraction, in (0, 1], at `length` (µm, not negative) along the fibre.
  double fraction(double length);

private:
  double narrowing(double length);
  void moveTo(double firstKnot);
  double drawnAt(std::uint32_t knot) const;

  const Calibre& Whole;
  int FibreId;
  double FirstKnot = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 4> Drawn = {}; ///< for the four knots from the first one on
  double Length = std::numeric_limits<double>::quiet_NaN();
  double Fraction = 1.0; ///< at that length
};

} // namespace cactus
