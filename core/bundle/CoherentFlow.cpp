// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/CoherentFlow.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Parallel.h"
#include "base/RandomVariates.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

/// Number of steps in which points cross one correlation length.
constexpr double stepsPerLength = 16.0;
/// Number of correlation lengths after which points that have not reached the angle go round in circles.
constexpr double farthest = 6.0;
/// Least number of steps.
constexpr int fewestSteps = 8;
/// Relative precision of the mean angle.
constexpr double precision = 1e-6;

double meanAngleOf(const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to, double height)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    sum += std::atan2((to[i] - from[i]).norm(), height);
  }
  return from.empty() ? 0.0 : sum / static_cast<double>(from.size());
}

} // namespace

Eigen::Vector2d FlowPaths::bend(std::size_t point, double share) const
{
  if (this->places.empty())
  {
    return Eigen::Vector2d::Zero();
  }
  const int last = static_cast<int>(this->places.size()) - 1;
  const auto bendAt = [&](int i) -> Eigen::Vector2d
  {
    const double along = static_cast<double>(i) / last;
    const auto place = [&](int j) -> const Eigen::Vector2d& { return this->places[static_cast<std::size_t>(j)][point]; };
    return place(i) - ((1.0 - along) * place(0) + along * place(last));
  };
  const int i = std::clamp(static_cast<int>(share * last), 0, last - 1);
  const double t = share * last - i;
  const Eigen::Vector2d from = bendAt(i);
  const Eigen::Vector2d to = bendAt(i + 1);
  // Beyond the ends the path continues as straight as possible.
  const Eigen::Vector2d before = i > 0 ? bendAt(i - 1) : Eigen::Vector2d(3.0 * (from - to) + bendAt(i + 2));
  const Eigen::Vector2d after = i + 1 < last ? bendAt(i + 2) : Eigen::Vector2d(3.0 * (to - from) + bendAt(i - 1));
  return from +
         0.5 * t * (to - before + t * (2.0 * before - 5.0 * from + 4.0 * to - after + t * (3.0 * (from - to) + after - before)));
}

CoherentFlow::CoherentFlow(const Rectangle& frame, double correlationLength, RandomEngine& engine)
  : Frame(frame)
  , Length(std::min(correlationLength, frame.size().maxCoeff()))
  , Wave(pi / frame.size().array())
{
  const double smallest = smallestLength * frame.size().maxCoeff();
  if (!(correlationLength >= smallest))
  {
    throw InvalidInput(text("CorrelationLength is ", correlationLength, " µm: give at least ", smallest,
      " µm in a bundle of this width, or DispersionModel Watson for directions that do not depend on each other"));
  }
  // Beyond these wave numbers coefficients are below a hundredth.
  const Eigen::Array2i modes = (2.0 / correlationLength * frame.size().array()).ceil().cast<int>().max(1);
  Coefficients.resize(modes[0], modes[1]);
  const double lowest = this->Wave.square().sum();
  double meanSquare = 0.0; // of the velocity
  for (int m = 0; m < modes[0]; ++m)
  {
    for (int n = 0; n < modes[1]; ++n)
    {
      const double square = (this->Wave * Eigen::Array2d(m + 1, n + 1)).square().sum();
      const double damping = std::exp(-0.125 * (square - lowest) * correlationLength * correlationLength);
      Coefficients(m, n) = damping * normal(engine);
      meanSquare += 0.25 * square * Coefficients(m, n) * Coefficients(m, n);
    }
  }
  Coefficients /= std::sqrt(meanSquare);
}

Eigen::Vector2d CoherentFlow::velocity(const Eigen::Vector2d& point, std::vector<double>& work) const
{
  const Eigen::Array2d phase = (point - this->Frame.lower).array() * this->Wave;
  const Eigen::Index columns = this->Coefficients.cols();
  work.resize(2 * static_cast<std::size_t>(columns));
  for (Eigen::Index n = 0; n < columns; ++n)
  {
    const double number = static_cast<double>(n + 1);
    work[2 * static_cast<std::size_t>(n)] = std::sin(number * phase[1]);
    work[2 * static_cast<std::size_t>(n) + 1] = number * this->Wave[1] * std::cos(number * phase[1]);
  }
  Eigen::Vector2d result = Eigen::Vector2d::Zero();
  for (Eigen::Index m = 0; m < this->Coefficients.rows(); ++m)
  {
    double sum = 0.0;
    double slope = 0.0;
    for (Eigen::Index n = 0; n < columns; ++n)
    {
      sum += this->Coefficients(m, n) * work[2 * static_cast<std::size_t>(n)];
      slope += this->Coefficients(m, n) * work[2 * static_cast<std::size_t>(n) + 1];
    }
    const double number = static_cast<double>(m + 1);
    result[0] += std::sin(number * phase[0]) * slope;
    result[1] -= number * this->Wave[0] * std::cos(number * phase[0]) * sum;
  }
  return result;
}

void CoherentFlow::advance(std::vector<Eigen::Vector2d>& points, double time, const Context& context) const
{
  constexpr std::size_t together = 256;
  parallelFor((points.size() + together - 1) / together, context,
    [&](std::size_t block)
    {
      std::vector<double> work;
      for (std::size_t i = block * together; i < std::min(points.size(), (block + 1) * together); ++i)
      {
        Eigen::Vector2d& p = points[i];
        const Eigen::Vector2d a = this->velocity(p, work);
        const Eigen::Vector2d b = this->velocity(p + 0.5 * time * a, work);
        const Eigen::Vector2d c = this->velocity(p + 0.5 * time * b, work);
        const Eigen::Vector2d d = this->velocity(p + time * c, work);
        p += time / 6.0 * (a + 2.0 * (b + c) + d);
      }
    });
}

double CoherentFlow::stepTime() const
{
  return this->Length / stepsPerLength; // the mean speed is about 1
}

double CoherentFlow::timeTo(
  const std::vector<Eigen::Vector2d>& start, double height, double meanAngle, bool& isFarEnough, const Context& context) const
{
  const double step = this->stepTime();
  std::vector<Eigen::Vector2d> points = start;
  double largest = 0.0;
  double timeOfLargest = 0.0;
  double reached = 0.0;
  for (double time = 0.0; time < farthest * this->Length; time += step)
  {
    const std::vector<Eigen::Vector2d> before = points;
    double low = 0.0;
    double lowAngle = reached;
    double high = step;
    this->advance(points, step, context);
    reached = meanAngleOf(start, points, height);
    if (reached < meanAngle)
    {
      if (reached > largest)
      {
        largest = reached;
        timeOfLargest = time + step;
      }
      continue;
    }
    // Within a step the mean angle is nearly linear in time.
    for (double highAngle = reached;;)
    {
      const double between = low + (high - low) * (meanAngle - lowAngle) / (highAngle - lowAngle);
      points = before;
      this->advance(points, between, context);
      reached = meanAngleOf(start, points, height);
      if (std::abs(reached - meanAngle) <= precision * meanAngle)
      {
        isFarEnough = true;
        return time + between;
      }
      (reached < meanAngle ? low : high) = between;
      (reached < meanAngle ? lowAngle : highAngle) = reached;
    }
  }
  isFarEnough = false;
  return timeOfLargest;
}

FlowPaths CoherentFlow::carry(
  const std::vector<Eigen::Vector2d>& points, double height, double meanAngle, const Context& context) const
{
  FlowPaths paths;
  const double time = this->timeTo(points, height, meanAngle, paths.isFarEnough, context);
  const int steps = std::max(fewestSteps, static_cast<int>(std::ceil(time / this->stepTime())));
  paths.places = { points };
  for (int i = 0; i < steps; ++i)
  {
    paths.places.push_back(paths.places.back());
    this->advance(paths.places.back(), time / steps, context);
  }
  return paths;
}

} // namespace cactus
