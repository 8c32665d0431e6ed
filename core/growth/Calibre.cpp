// SPDX-License-Identifier: BSD-3-Clause
#include "growth/Calibre.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Random.h"
#include "growth/CubicSpline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cactus
{

namespace
{

/// Distance (µm) of the knots between which the calibre varies, and of the places between which it varies linearly. Beads follow
/// each other every few µm (Andersson et al. 2020); shorter ones would give a grainy surface rather than an uneven calibre, and
/// need many triangles.
constexpr double knotSpacing = 2.0;
constexpr double linearLength = 1.0;

} // namespace

Calibre::Calibre(const SeedOptions& options)
  : Options(options)
{
  if (!(options.surfaceRoughness >= 0.0 && options.surfaceRoughness <= 0.5))
  {
    throw InvalidInput("SurfaceRoughness must be between 0 and 0.5");
  }
}

double Calibre::longestPiece() const
{
  return this->varies() ? linearLength : std::numeric_limits<double>::infinity();
}

FibreCalibre::FibreCalibre(const Calibre& calibre, int fibreId)
  : Whole(calibre)
  , FibreId(fibreId)
{
}

double FibreCalibre::fraction(double length)
{
  if (this->Whole.varies() && length != this->Length)
  {
    this->Length = length;
    this->Fraction = 1.0 - this->Whole.Options.surfaceRoughness * this->narrowing(length);
  }
  return this->Fraction;
}

/// Returns u(l).
double FibreCalibre::narrowing(double length)
{
  const double knots = length / knotSpacing;
  const double whole = std::floor(knots);
  const double t = knots - whole;
  const std::array<double, 4> weights = cubicSplineWeights(t);
  this->moveTo(whole);
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
  {
    sum += weights[k] * this->Drawn[k] * this->Drawn[k];
  }
  return sum;
}

/// Draws numbers for the four knots from this one on, and keeps those drawn before.
void FibreCalibre::moveTo(double firstKnot)
{
  if (firstKnot == this->FirstKnot)
  {
    return;
  }
  std::size_t known = 0;
  if (firstKnot == this->FirstKnot + 1.0)
  {
    std::copy(this->Drawn.begin() + 1, this->Drawn.end(), this->Drawn.begin());
    known = 3;
  }
  this->FirstKnot = firstKnot;
  const auto first = static_cast<std::uint32_t>(std::fmod(firstKnot, 4294967296.0));
  for (std::size_t k = known; k < 4; ++k)
  {
    this->Drawn[k] = this->drawnAt(first + static_cast<std::uint32_t>(k));
  }
}

/// Returns the root of a knot's coefficient.
double FibreCalibre::drawnAt(std::uint32_t knot) const
{
  RandomEngine engine =
    randomStream(this->Whole.Options.seed, RandomStage::Seeds, (std::uint64_t(std::uint32_t(this->FibreId)) << 32) | knot);
  return std::sin(pi * uniform(engine));
}

} // namespace cactus
