// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/WaveField.h"

#include "base/Constants.h"
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

WaveField::Value WaveField::at(const Eigen::Vector2d& point, const Plane& plane, Work& work) const
{
  // cos and sin of n times the phase of one period along y, for n from −Most to Most.
  const auto most = static_cast<std::size_t>(this->Most);
  const std::size_t size = 2 * most + 1;
  work.resize(2 * size);
  double* real = work.data();
  double* imaginary = real + size;
  const double cosine = std::cos(this->WaveNumber * point.y());
  const double sine = std::sin(this->WaveNumber * point.y());
  real[most] = 1.0;
  imaginary[most] = 0.0;
  for (std::size_t n = 1; n <= most; ++n)
  {
    real[most + n] = real[most + n - 1] * cosine - imaginary[most + n - 1] * sine;
    imaginary[most + n] = real[most + n - 1] * sine + imaginary[most + n - 1] * cosine;
    real[most - n] = real[most + n];
    imaginary[most - n] = -imaginary[most + n];
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
      const double before = realX;
      realX = before * cosineX - imaginaryX * sineX;
      imaginaryX = before * sineX + imaginaryX * cosineX;
    }
    double sumReal = 0.0;
    double sumImaginary = 0.0;
    double slopeReal = 0.0; // weighted by the periods along y
    double slopeImaginary = 0.0;
    const double* factorReal = real + (row.firstY + this->Most);
    const double* factorImaginary = imaginary + (row.firstY + this->Most);
    for (int i = 0; i < row.count; ++i)
    {
      const double a = plane.real[row.begin + static_cast<std::size_t>(i)];
      const double b = plane.imaginary[row.begin + static_cast<std::size_t>(i)];
      const double productReal = a * factorReal[i] - b * factorImaginary[i];
      const double productImaginary = a * factorImaginary[i] + b * factorReal[i];
      const double number = row.firstY + i;
      sumReal += productReal;
      sumImaginary += productImaginary;
      slopeReal += number * productReal;
      slopeImaginary += number * productImaginary;
    }
    value.stream += sumReal * realX - sumImaginary * imaginaryX;
    value.curl.x() -= slopeReal * imaginaryX + slopeImaginary * realX;
    value.curl.y() += row.x * (sumReal * imaginaryX + sumImaginary * realX);
  }
  value.stream /= this->Deviation;
  value.curl *= this->WaveNumber;
  return value;
}

} // namespace cactus
