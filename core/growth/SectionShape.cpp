// SPDX-License-Identifier: BSD-3-Clause
#include "growth/SectionShape.h"

#include "base/Constants.h"
#include "base/Random.h"
#include "growth/CubicSpline.h"
#include "growth/SeedPoints.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

/// The g-ratio of fibres that have none of their own.
constexpr double usualGRatio = 0.7;
/// Discs farther from the centre line would leave a waist between them, which myelin would deepen.
constexpr double mostElongation = 0.4;
/// Fibres of a larger radius (µm) are the rounder the thicker they are: axons of 0.5 µm have axis ratios of 0.76 (mouse), such of
/// 1.2 µm 0.84 (monkey, Andersson et al. 2020).
constexpr double thickFrom = 0.7;
/// Distance (µm) of the knots between which the direction turns.
constexpr double turningLength = 4.0;
/// The length of a random vector below which a section is rounder, relative to the usual ones.
constexpr double roundBelow = 0.25;

/// (1 - q) / (1 + q) for an axis ratio q: how far the semi-axes differ from their mean, as a fraction of it.
double differenceOf(double axisRatio)
{
  return (1.0 - axisRatio) / (1.0 + axisRatio);
}

/// The difference that neighbours alone make: measured on final inner surfaces of round seeds, which have axis ratios of 0.97,
/// 0.97, 0.93, 0.90, 0.84 and 0.81 at fractions of 0.5, 0.6, 0.7, 0.8, 0.9 and 0.95.
double differenceByNeighbours(double grownFraction)
{
  const double dense = std::max(0.0, (grownFraction - 0.55) / 0.4);
  return 0.015 + 0.085 * dense * std::sqrt(dense);
}

/// Returns the difference that a seed needs where it is largest for this mean difference on final surfaces; infinite where no
/// seed has it. Sections pass through round ones, smoothing takes some, and neighbours the more the denser they are and the more
/// elongated. Measured as above, for axis ratios from 0.7 to 0.83 at fractions from 0.6 to 0.9.
double seededDifference(double mean, double grownFraction)
{
  const double taken = 0.8 + 13.0 * std::max(0.0, grownFraction - 0.6);
  const double left = 0.8 - taken * mean;
  return left > 0.0 ? mean / left : std::numeric_limits<double>::infinity();
}

/// Returns how far the outer discs lie from the centre line, as a fraction of the radius, in a section of this difference: 0.424
/// d, the amplitude of cos 2φ in |cos φ|, and a little more.
double offsetOf(double difference)
{
  constexpr double linear = 4.0 / (3.0 * pi);
  constexpr double quadratic = 0.16;
  return (std::sqrt(linear * linear + 4.0 * quadratic * difference) - linear) / (2.0 * quadratic);
}

} // namespace

double SectionShape::discRadius(double offset)
{
  // Discs of radius r, the outer ones 2 d apart, have the area π r² + 4 d r, but for terms of d³; here it is π.
  const double half = 2.0 * offset / pi;
  return std::sqrt(1.0 + half * half) - half;
}

SectionShape::SectionShape(double axisRatio, double gRatio, double grownFraction, double radius)
{
  if (std::isnan(axisRatio))
  {
    return;
  }
  // Differences by two causes that know nothing of each other add up in squares. Myelin is as thick all around, so an axon's
  // difference is that of the whole fibre divided by g.
  const double wanted = differenceOf(axisRatio);
  const double given = differenceByNeighbours(grownFraction);
  if (wanted > given)
  {
    const double seeded = seededDifference(std::sqrt(wanted * wanted - given * given), grownFraction);
    const double elongation = std::min(offsetOf(gRatio * std::min(seeded, 1.0)), mostElongation);
    this->Elongation = elongation * std::min(1.0, thickFrom / radius);
  }
}

SectionShape SectionShape::ofPoints(double core)
{
  SectionShape shape;
  shape.Core = core;
  return shape;
}

std::vector<SectionShape> sectionShapes(const Fibres& fibres, const SeedOptions& options)
{
  if (options.pointDensity > 0.0)
  {
    return std::vector<SectionShape>(fibres.size(), SectionShape::ofPoints(SeedPoints::core));
  }
  std::vector<SectionShape> shapes;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const double gRatio = fibres.columns.value(targetGRatioColumn.name, f);
    shapes.emplace_back(fibres.columns.value(targetAxisRatioColumn.name, f), std::isnan(gRatio) ? usualGRatio : gRatio,
      options.grownFraction, fibres.targetRadii[f]);
  }
  return shapes;
}

SectionTurn::SectionTurn(const SectionShape& shape, std::uint64_t seed, int fibreId, double period)
  : Elongation(shape.elongation())
  , Seed(seed)
  , FibreId(fibreId)
  , Knots(period > 0.0 ? static_cast<std::uint32_t>(std::max(1.0, std::round(period / turningLength))) : 0)
  , KnotSpacing(period > 0.0 ? period / this->Knots : turningLength)
{
  this->DrawnKnots.fill(std::numeric_limits<std::uint32_t>::max());
}

Eigen::Vector3d SectionTurn::offset(double length, const Eigen::Vector3d& tangent)
{
  const double knots = length / this->KnotSpacing;
  const double whole = std::floor(knots);
  const std::array<double, 4> weights = cubicSplineWeights(knots - whole);
  Eigen::Vector3d random = Eigen::Vector3d::Zero();
  for (std::uint32_t k = 0; k < 4; ++k)
  {
    random += weights[k] * this->drawnAt(static_cast<std::uint32_t>(whole) + k);
  }
  const Eigen::Vector3d across = random - random.dot(tangent) * tangent;
  return this->Elongation * across / std::sqrt(across.squaredNorm() + roundBelow * roundBelow);
}

/// Returns the random vector of a knot, of components from -1 to 1.
const Eigen::Vector3d& SectionTurn::drawnAt(std::uint32_t knot)
{
  const std::uint32_t own = this->Knots > 0 ? knot % this->Knots : knot;
  const std::size_t place = own % this->Drawn.size();
  if (this->DrawnKnots[place] != own)
  {
    RandomEngine engine =
      randomStream(this->Seed, RandomStage::Sections, (std::uint64_t(std::uint32_t(this->FibreId)) << 32) | own);
    this->DrawnKnots[place] = own;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Drawn[place][axis] = std::cos(pi * uniform(engine));
    }
  }
  return this->Drawn[place];
}

} // namespace cactus
