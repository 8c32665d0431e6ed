// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Random.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// A random function of the place in space that has the same statistics everywhere: a sum of plane waves. On every plane across z
/// it repeats with a period, and holds each wave of its spectrum once, so that its mean squares over a period do not depend on
/// chance. As the stream function of a flow across z it gives velocities whose components have a mean square of 1.
///
/// The wave of the lateral wave vector k has the amplitude exp(−k²ℓ²/8), ℓ being the lateral correlation length: the function's
/// correlation at a lateral distance d is exp(−d²/ℓ²). Its wave number along z is drawn from a normal distribution.
class WaveField
{
public:
  /// How the waves go along z.
  struct Along
  {
    double waveNumber = 0.0; ///< mean (1/µm), of either sign
    double deviation = 0.0;  ///< (1/µm)
    double period = 0.0;     ///< µm; if not 0, each wave has a whole number of periods on it, at least one
  };

  /// The sum over the waves of one row at one y, before their common factor along x, and its derivative by the phase along y.
  struct RowSum
  {
    double real = 0.0;
    double imaginary = 0.0;
    double slopeReal = 0.0;
    double slopeImaginary = 0.0;
  };

  /// The field on a plane across z.
  struct Plane
  {
    std::vector<double> real; ///< by wave
    std::vector<double> imaginary;
    std::vector<RowSum> table; ///< by place along y and row, see tabulate(); or empty
  };

  /// The function at a point, over its standard deviation, and its curl (∂/∂y, −∂/∂x).
  struct Value
  {
    double stream = 0.0;
    Eigen::Vector2d curl = Eigen::Vector2d::Zero();
  };

  /// Room for the work of at(), one for each thread.
  using Work = std::vector<double>;

  /// Draws the field. Lengths in µm; a correlation length beyond a quarter of the period leaves few waves.
  WaveField(double period, double correlationLength, const Along& along, RandomEngine& engine);

  std::size_t waves() const { return this->Waves.size(); }
  Plane plane(double z) const;
  /// Returns the function at a point: from the sums of all waves, or, on a plane with a table, from sums interpolated in it.
  Value at(const Eigen::Vector2d& point, const Plane& plane, Work& work) const;

  /// Tells whether a plane for so many points should have a table: their number and that of the waves both grow with the domain's
  /// area.
  bool needsTable(std::size_t points) const;
  /// Gives a plane a table, of which at() interpolates along y by cubics: then the work for a point grows with the root of the
  /// number of waves. The curl remains that of the stream, and differs from the sums' by less than 0.001. Throws Cancelled. Gives
  /// the same bits on any number of threads.
  void tabulate(Plane& plane, const Context& context) const;

private:
  struct Wave
  {
    double amplitude;
    double along; ///< wave number along z
    double phase;
  };
  /// Waves of the same number of periods along x, by their periods along y, which follow one another.
  struct Row
  {
    int x;
    int firstY;
    int count;
    std::size_t begin; ///< among all waves
  };

  std::size_t places() const;
  void setFactors(double y, Work& factors) const;
  RowSum sumOf(const Row& row, const Plane& plane, const Work& factors) const;

  double WaveNumber; ///< of one period
  int Most = 0;      ///< periods of any wave along x or y
  double Deviation = 1.0;
  std::vector<Wave> Waves;
  std::vector<Row> Rows;
};

} // namespace cactus
