// SPDX-License-Identifier: BSD-3-Clause
#include "growth/Calibre.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Random.h"

#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

/// Distance (µm) of the knots between which the calibre varies, and of the places between which it varies linearly. Beads follow
/// each other every few µm (Andersson et al. 2020); shorter ones would grow into a grainy surface rather than an uneven calibre,
/// and take many triangles.
constexpr double knotSpacing = 2.0;
constexpr double linearLength = 1.0;

} // namespace

Calibre::Calibre(const CalibreOptions& options)
  : Options(options)
{
  if (!(options.surfaceRoughness >= 0.0 && options.surfaceRoughness <= 0.5))
  {
    throw InvalidInput("SurfaceRoughness must be between 0 and 0.5");
  }
}

double Calibre::fraction(int fibreId, double length) const
{
  return 1.0 - this->Options.surfaceRoughness * this->narrowing(fibreId, length);
}

double Calibre::longestPiece() const
{
  return this->varies() ? linearLength : std::numeric_limits<double>::infinity();
}

/// u(l).
double Calibre::narrowing(int fibreId, double length) const
{
  const double knots = length / knotSpacing;
  const double whole = std::floor(knots);
  const double t = knots - whole;
  const auto first = static_cast<std::uint32_t>(std::fmod(whole, 4294967296.0));
  const double weights[4] = { (1.0 - t) * (1.0 - t) * (1.0 - t) / 6.0, (4.0 + t * t * (3.0 * t - 6.0)) / 6.0,
    (1.0 + 3.0 * t * (1.0 + t * (1.0 - t))) / 6.0, t * t * t / 6.0 };
  double sum = 0.0;
  for (std::uint32_t k = 0; k < 4; ++k)
  {
    RandomEngine engine =
      randomStream(this->Options.seed, RandomStage::Seeds, (std::uint64_t(std::uint32_t(fibreId)) << 32) | (first + k));
    const double sine = std::sin(pi * uniform(engine));
    sum += weights[k] * sine * sine;
  }
  return sum;
}

} // namespace cactus
