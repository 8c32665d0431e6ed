// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/WaveField.h"

#include "base/Constants.h"
#include "base/Parallel.h"
#include "base/RandomVariates.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

/// Waves whose velocity is below this share of the largest are left out.
constexpr double faintest = 0.01;

/// exp(−κ²/8) κ, with κ = kℓ, is `faintest` of its maximum at this κ.
constexpr double largestWaveNumber = 7.15;

/// Returns the nearest wave number of a whole number of waves on the period, if there is one, but not 0.
double wholeNumber(double number, double period)
{
  if (period == 0.0)
  {
    return number;
  }
  const double waves = std::max(1.0, std::round(std::abs(number) * period / (2.0 * pi)));
  return std::copysign(2.0 * pi * waves / period, number);
}

/// The cubics between two places of a table, with the values and derivatives that it has at both.
class Cubic
{
public:
  Cubic() = default;
  /// t: from 0 to 1 between the places; distance: between them.
  Cubic(double t, double distance)
    : After(t * t * (3.0 - 2.0 * t))
    , SlopeBefore(distance * t * (1.0 - t) * (1.0 - t))
    , SlopeAfter(distance * t * t * (t - 1.0))
    , Rise(6.0 * t * (1.0 - t) / distance)
    , RiseBefore((1.0 - t) * (1.0 - 3.0 * t))
    , RiseAfter(t * (3.0 * t - 2.0))
  {
  }

  /// The derivatives by the phase of the real and imaginary parts are −slopeImaginary and slopeReal.
  WaveField::RowSum between(const WaveField::RowSum& before, const WaveField::RowSum& after) const
  {
    WaveField::RowSum sum;
    const double real = after.real - before.real;
    const double imaginary = after.imaginary - before.imaginary;
    sum.real =
      before.real + this->After * real - this->SlopeBefore * before.slopeImaginary - this->SlopeAfter * after.slopeImaginary;
    sum.imaginary =
      before.imaginary + this->After * imaginary + this->SlopeBefore * before.slopeReal + this->SlopeAfter * after.slopeReal;
    sum.slopeReal = this->Rise * imaginary + this->RiseBefore * before.slopeReal + this->RiseAfter * after.slopeReal;
    sum.slopeImaginary = -this->Rise * real + this->RiseBefore * before.slopeImaginary + this->RiseAfter * after.slopeImaginary;
    return sum;
  }

private:
  double After = 0.0;
  double SlopeBefore = 0.0;
  double SlopeAfter = 0.0;
  double Rise = 0.0;
  double RiseBefore = 0.0;
  double RiseAfter = 0.0;
};

} // namespace

WaveField::WaveField(double period, double correlationLength, const Along& along, RandomEngine& engine)
  : WaveNumber(2.0 * pi / period)
{
  const double scale = this->WaveNumber * correlationLength;
  this->Most = std::max(1, static_cast<int>(largestWaveNumber / scale));
  const auto velocityOf = [&](int x, int y)
  {
    const double squared = scale * scale * static_cast<double>(x * x + y * y);
    return std::exp(-0.125 * squared) * std::sqrt(squared);
  };
  double largest = 0.0;
  for (int i = 1; i <= this->Most; ++i)
  {
    largest = std::max({ largest, velocityOf(i, 0), velocityOf(i, i) });
  }
  double streamSquare = 0.0;
  double velocitySquare = 0.0;
  for (int x = 0; x <= this->Most; ++x)
  {
    Row row = { x, 0, 0, this->Waves.size() };
    // A wave and its opposite are one.
    for (int y = x == 0 ? 1 : -this->Most; y <= this->Most; ++y)
    {
      const double velocity = velocityOf(x, y);
      if (velocity < faintest * largest)
      {
        continue;
      }
      row.firstY = row.count == 0 ? y : row.firstY;
      ++row.count;
      const double waveNumber = this->WaveNumber * std::sqrt(static_cast<double>(x * x + y * y));
      const double amplitude = velocity / waveNumber;
      const double sign = uniform(engine) < 0.5 ? -1.0 : 1.0;
      const double number = wholeNumber(sign * (along.waveNumber + along.deviation * normal(engine)), along.period);
      this->Waves.push_back({ amplitude, number, 2.0 * pi * uniform(engine) });
      streamSquare += 0.5 * amplitude * amplitude;
      velocitySquare += 0.25 * velocity * velocity; // of one component
    }
    if (row.count > 0)
    {
      this->Rows.push_back(row);
    }
  }
  for (Wave& wave : this->Waves)
  {
    wave.amplitude /= std::sqrt(velocitySquare);
  }
  this->Deviation = std::sqrt(streamSquare / velocitySquare);
}

WaveField::Plane WaveField::plane(double z) const
{
  Plane plane;
  plane.real.reserve(this->Waves.size());
  plane.imaginary.reserve(this->Waves.size());
  for (const Wave& wave : this->Waves)
  {
    const double phase = wave.along * z + wave.phase;
    plane.real.push_back(wave.amplitude * std::cos(phase));
    plane.imaginary.push_back(wave.amplitude * std::sin(phase));
  }
  return plane;
}

/// Sets cos and sin of n times the phase of one period along y, for n from −Most to Most.
void WaveField::setFactors(double y, Work& factors) const
{
  const auto most = static_cast<std::size_t>(this->Most);
  const std::size_t size = 2 * most + 1;
  factors.resize(2 * size);
  double* real = factors.data();
  double* imaginary = real + size;
  const double cosine = std::cos(this->WaveNumber * y);
  const double sine = std::sin(this->WaveNumber * y);
  real[most] = 1.0;
  imaginary[most] = 0.0;
  for (std::size_t n = 1; n <= most; ++n)
  {
    real[most + n] = real[most + n - 1] * cosine - imaginary[most + n - 1] * sine;
    imaginary[most + n] = real[most + n - 1] * sine + imaginary[most + n - 1] * cosine;
    real[most - n] = real[most + n];
    imaginary[most - n] = -imaginary[most + n];
  }
}

WaveField::RowSum WaveField::sumOf(const Row& row, const Plane& plane, const Work& factors) const
{
  const double* real = factors.data() + (row.firstY + this->Most);
  const double* imaginary = real + factors.size() / 2;
  RowSum sum;
  for (int i = 0; i < row.count; ++i)
  {
    const double a = plane.real[row.begin + static_cast<std::size_t>(i)];
    const double b = plane.imaginary[row.begin + static_cast<std::size_t>(i)];
    const double productReal = a * real[i] - b * imaginary[i];
    const double productImaginary = a * imaginary[i] + b * real[i];
    const double number = row.firstY + i;
    sum.real += productReal;
    sum.imaginary += productImaginary;
    sum.slopeReal += number * productReal;
    sum.slopeImaginary += number * productImaginary;
  }
  return sum;
}

/// Returns the number of places along y that a table has.
std::size_t WaveField::places() const
{
  constexpr std::size_t perShortestWave = 16;
  return perShortestWave * static_cast<std::size_t>(this->Most);
}

bool WaveField::needsTable(std::size_t points) const
{
  constexpr std::size_t many = 400; // waves; of fewer the sum is as fast
  return this->Waves.size() > many && points > this->places();
}

void WaveField::tabulate(Plane& plane, const Context& context) const
{
  plane.table.resize(this->places() * this->Rows.size());
  parallelFor(this->places(), context,
    [&](std::size_t place)
    {
      Work factors;
      this->setFactors(2.0 * pi / this->WaveNumber * static_cast<double>(place) / static_cast<double>(this->places()), factors);
      for (std::size_t row = 0; row < this->Rows.size(); ++row)
      {
        plane.table[place * this->Rows.size() + row] = this->sumOf(this->Rows[row], plane, factors);
      }
    });
}

WaveField::Value WaveField::at(const Eigen::Vector2d& point, const Plane& plane, Work& work) const
{
  const RowSum* before = nullptr;
  const RowSum* after = nullptr;
  Cubic cubic;
  if (plane.table.empty())
  {
    this->setFactors(point.y(), work);
  }
  else
  {
    const auto places = static_cast<double>(this->places());
    const double along = this->WaveNumber / (2.0 * pi) * point.y();
    const double place = (along - std::floor(along)) * places;
    const auto lower = std::min(static_cast<std::size_t>(place), this->places() - 1);
    before = plane.table.data() + lower * this->Rows.size();
    after = plane.table.data() + (lower + 1) % this->places() * this->Rows.size();
    cubic = Cubic(place - static_cast<double>(lower), 2.0 * pi / places);
  }
  const double cosineX = std::cos(this->WaveNumber * point.x());
  const double sineX = std::sin(this->WaveNumber * point.x());
  double realX = 1.0;
  double imaginaryX = 0.0;
  int reached = 0;
  Value value;
  for (const Row& row : this->Rows)
  {
    for (; reached < row.x; ++reached)
    {
      const double former = realX;
      realX = former * cosineX - imaginaryX * sineX;
      imaginaryX = former * sineX + imaginaryX * cosineX;
    }
    const RowSum sum = before == nullptr ? this->sumOf(row, plane, work) : cubic.between(*before++, *after++);
    value.stream += sum.real * realX - sum.imaginary * imaginaryX;
    value.curl.x() -= sum.slopeReal * imaginaryX + sum.slopeImaginary * realX;
    value.curl.y() += row.x * (sum.real * imaginaryX + sum.imaginary * realX);
  }
  value.stream /= this->Deviation;
  value.curl *= this->WaveNumber;
  return value;
}

} // namespace cactus
