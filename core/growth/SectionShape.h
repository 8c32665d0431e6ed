// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "growth/Calibre.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// How elongated the sections of a fibre's seed are: the union of three equal discs, one on the centre line and one on either
/// side of it, of the area of the capsule's section. Of a seed of points (see SeedPoints) only its bounds are known.
///
/// The discs overlap, and reach no farther from the centre line than `reach()` times the fibre's radius. On the centre line the
/// seed field is at least `core()` times the radius: the disc there alone keeps a fibre in one piece that leads its neighbours on
/// its centre line.
class SectionShape
{
public:
  /// A round section.
  SectionShape() = default;

  /// Elongates the section so that the axon (inner surface) of a fibre that is grown to this volume fraction has about this mean
  /// axis ratio. Neighbours flatten sections as they grow, so that less is needed at high fractions, and nothing where they
  /// flatten them enough. axisRatio: minor over major axis of the ellipse with the section's second moments, in [0.7, 1], NaN
  /// for round ones; grownFraction: 0 if it is not known.
  /// radius: TargetRadius (µm) of the fibre; thick fibres are rounder, as in tissue, and so do not crowd out thin ones beside
  /// them.
  SectionShape(double axisRatio, double gRatio, double grownFraction, double radius);

  /// Returns the shape of a seed of points: within the capsule, with a chain of this core (a fraction of the radius) on the
  /// centre line.
  static SectionShape ofPoints(double core);

  /// Tells whether the section has one disc on the centre line alone.
  bool isRound() const { return this->Elongation == 0.0; }
  /// Returns the largest distance of an outer disc's centre from the centre line. This and all below are fractions of the fibre's
  /// radius.
  double elongation() const { return this->Elongation; }
  double reach() const { return discRadius(this->Elongation) + this->Elongation; }
  double core() const { return this->Core * discRadius(this->Elongation); }
  /// Returns the radius of discs of which the outer ones have this distance from the centre line.
  static double discRadius(double offset);

private:
  double Elongation = 0.0;
  double Core = 1.0;
};

/// Returns the shapes of all fibres: each has its TargetAxisRatio, if any, and the g-ratio of its TargetGRatio, or 0.7; those of
/// seeds of points if the options have any.
std::vector<SectionShape> sectionShapes(const Fibres& fibres, const SeedOptions& options);

/// The direction in which one fibre's sections are elongated, along the fibre: a smooth random function of the length, which
/// depends only on seed, fibre id and length. Here and there it passes through a round section.
class SectionTurn
{
public:
  /// Length (µm) along which it may be taken to turn linearly.
  static constexpr double longestPiece = 1.0;

  /// period: µm of length after which the fibre repeats, 0 if it does not.
  SectionTurn(const SectionShape& shape, std::uint64_t seed, int fibreId, double period);

  /// Returns the place of one outer disc's centre relative to the centre line, as a fraction of the fibre's radius; the other one
  /// lies opposite. length: µm, not negative; tangent: unit vector along the fibre.
  Eigen::Vector3d offset(double length, const Eigen::Vector3d& tangent);

private:
  const Eigen::Vector3d& drawnAt(std::uint32_t knot);

  double Elongation;
  std::uint64_t Seed;
  int FibreId;
  std::uint32_t Knots = 0; ///< in a period; 0 without one
  double KnotSpacing;      ///< µm
  /// The last draws, each at the place of its knot modulo their number.
  std::array<Eigen::Vector3d, 4> Drawn;
  std::array<std::uint32_t, 4> DrawnKnots;
};

} // namespace cactus
