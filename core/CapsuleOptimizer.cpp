// SPDX-License-Identifier: BSD-3-Clause
#include "CapsuleOptimizer.h"

#include "Capsules.h"
#include "Error.h"
#include "NeighbourSearch.h"
#include "OverlapCost.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace cactus
{

namespace
{

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The state of one descent: positions, radii, velocities and the neighbour lists that go with them.
class Descent
{
public:
  Descent(Fibres& fibres, const CapsuleOptimizerOptions& options, int threads)
    : State(fibres)
    , Options(options)
    , Threads(threads)
    , Costs(fibres, options.weights, options.packingLimit)
    , Bodies(capsulesOf(fibres))
    , ReferenceRadii(fibres.radii)
    , Gradient(fibres.points.size())
    , RadiusGradient(fibres.points.size())
    , Stiffness(fibres.points.size())
    , Velocity(fibres.points.size(), Eigen::Vector3d::Zero())
    , RadiusVelocity(fibres.points.size(), 0.0)
  {
    double sum = 0.0;
    for (const double radius : fibres.radii)
    {
      sum += radius;
    }
    this->MeanRadius = sum / static_cast<double>(fibres.radii.size());
    this->LargestDiameter = 2.0 * *std::max_element(fibres.radii.begin(), fibres.radii.end());
  }

  /// Cost, penetration and gradient of the present state.
  ConvergenceRow evaluate()
  {
    this->refreshNeighbours();
    ConvergenceRow row;
    const Clock::time_point start = Clock::now();
    const OverlapTotals overlap = evaluateOverlap(
      this->Bodies, this->Neighbours, this->Options.safetyMargin, this->Options.overlapTolerance, this->Threads, this->Overlaps);
    this->EvaluationSeconds += secondsSince(start);
    this->PairEvaluations += static_cast<double>(this->Neighbours.indices.size());
    row.overlapCost = this->Options.overlapWeight * overlap.cost;
    row.maximumPenetration = std::max(0.0, overlap.penetration);
    row.overlappingPairs = overlap.overlappingPairs;
    const std::size_t count = this->State.size();
    std::vector<FibreCostTotals> perFibre(count);
#pragma omp parallel for num_threads(this->Threads) schedule(dynamic, 16)
    for (std::size_t f = 0; f < count; ++f)
    {
      this->gatherOverlap(f);
      perFibre[f] = this->Costs.add(this->State, f, this->Relaxation, this->Gradient, this->RadiusGradient, this->Stiffness);
    }
    for (const FibreCostTotals& totals : perFibre)
    {
      row.curvatureCost += totals.curvature;
      row.lengthCost += totals.length;
      row.radiusCost += totals.radius;
      row.compactnessCost += totals.compactness;
    }
    return row;
  }

  void step()
  {
    const std::size_t count = this->State.size();
    std::vector<double> moved(count, 0.0);
#pragma omp parallel for num_threads(this->Threads) schedule(dynamic, 16)
    for (std::size_t f = 0; f < count; ++f)
    {
      moved[f] = this->Options.method == DescentMethod::Momentum ? this->stepMomentum(f) : this->stepAdagrad(f);
      this->copyToCapsules(f);
    }
    this->Moved += *std::max_element(moved.begin(), moved.end());
    ++this->StepsSinceSearch;
    if (this->Options.method == DescentMethod::Momentum)
    {
      this->Relaxation = std::max(1e-4, this->Relaxation * this->Options.relaxation);
    }
  }

  /// Hands over what this descent has cost so far.
  void account(OptimisationResult& result) const
  {
    result.pairEvaluations = this->PairEvaluations;
    result.neighbourSearches = this->Searches;
    result.evaluationSeconds = this->EvaluationSeconds;
    result.searchSeconds = this->SearchSeconds;
  }

private:
  /// The lists reach a little further than contact and hold until something could have come that far.
  void refreshNeighbours()
  {
    const double needed = (this->Options.safetyMargin - 1.0) * this->LargestDiameter;
    if (!this->Neighbours.offsets.empty() && 2.0 * this->Moved + needed <= this->Reach)
    {
      return;
    }
    // Follow the pace: a list should hold for about twenty steps.
    this->Reach = needed + std::min(std::max(40.0 * this->lastMove(), 0.05 * this->MeanRadius), 0.6 * this->MeanRadius);
    const Clock::time_point start = Clock::now();
    findNeighbours(this->Bodies, { this->Reach, 0.0 }, this->Threads, this->Neighbours);
    this->SearchSeconds += secondsSince(start);
    ++this->Searches;
    this->Moved = 0.0;
    this->StepsSinceSearch = 0;
  }

  double lastMove() const
  {
    return this->StepsSinceSearch > 0 ? this->Moved / this->StepsSinceSearch : 0.0;
  }

  /// Sums what the two capsules at each control point want of it.
  void gatherOverlap(std::size_t f)
  {
    const std::size_t begin = this->State.offsets[f];
    const std::size_t end = this->State.offsets[f + 1];
    const std::size_t firstCapsule = begin - f;
    const double weight = this->Options.overlapWeight;
    for (std::size_t i = begin; i < end; ++i)
    {
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
      double radius = 0.0;
      double stiffness = 0.0;
      if (i > begin)
      {
        const CapsuleOverlap& before = this->Overlaps[firstCapsule + (i - begin) - 1];
        gradient += Eigen::Vector3d::Map(before.gradient1);
        radius += before.radius1;
        stiffness += before.stiffness1;
      }
      if (i + 1 < end)
      {
        const CapsuleOverlap& after = this->Overlaps[firstCapsule + (i - begin)];
        gradient += Eigen::Vector3d::Map(after.gradient0);
        radius += after.radius0;
        stiffness += after.stiffness0;
      }
      this->Gradient[i] = weight * gradient;
      this->RadiusGradient[i] = weight * radius;
      this->Stiffness[i] = weight * stiffness;
    }
  }

  /// Displaces the fibre's control points and returns the largest change of a position plus that of a radius.
  double stepMomentum(std::size_t f)
  {
    const std::size_t begin = this->State.offsets[f];
    const std::size_t end = this->State.offsets[f + 1];
    this->smoothGradient(f);
    for (std::size_t i = begin; i < end; ++i)
    {
      Eigen::Vector3d& velocity = this->Velocity[i];
      velocity = this->Options.momentum * velocity - this->Options.stepSize * this->Gradient[i];
      const double speed = velocity.norm();
      const double limit = 0.3 * this->State.radii[i];
      if (speed > limit)
      {
        velocity *= limit / speed;
      }
    }
    this->constrainEnds(f, this->Velocity[begin], this->Velocity[end - 1]);
    double largest = 0.0;
    for (std::size_t i = begin; i < end; ++i)
    {
      this->State.points[i] += this->Velocity[i];
      double change = this->Velocity[i].norm();
      if (this->Options.radiusTolerance > 0.0)
      {
        double& radiusVelocity = this->RadiusVelocity[i];
        const double radiusStiffness = this->diagonal(i) + 2.0 * this->Options.weights.radius;
        radiusVelocity =
          this->Options.momentum * radiusVelocity - this->Options.stepSize / radiusStiffness * this->RadiusGradient[i];
        change += this->changeRadius(i, radiusVelocity);
      }
      largest = std::max(largest, change);
    }
    return largest;
  }

  /// Replaces the gradient of a fibre by M⁻¹ · gradient, with M the diagonal stiffness plus a stiff thread along the fibre: the
  /// fibre moves as a whole where its neighbours push it as a whole, instead of kinking control point by control point.
  void smoothGradient(std::size_t f)
  {
    const std::size_t begin = this->State.offsets[f];
    const std::size_t end = this->State.offsets[f + 1];
    std::vector<double> upper(end - begin, 0.0);
    for (std::size_t i = begin; i < end; ++i)
    {
      const double before = i > begin ? this->thread(i - 1) : 0.0;
      const double after = i + 1 < end ? this->thread(i) : 0.0;
      double diagonal = this->diagonal(i) + before + after;
      if (i > begin)
      {
        diagonal += before * upper[i - begin - 1];
        this->Gradient[i] += before * this->Gradient[i - 1];
      }
      upper[i - begin] = -after / diagonal;
      this->Gradient[i] /= diagonal;
    }
    for (std::size_t i = end - 1; i > begin; --i)
    {
      this->Gradient[i - 1] -= upper[i - 1 - begin] * this->Gradient[i];
    }
  }

  /// Never zero, so that a point which nothing touches stays where it is.
  double diagonal(std::size_t i) const
  {
    return this->Stiffness[i] + 1e-3 * this->State.radii[i] * this->State.radii[i];
  }

  double thread(std::size_t i) const
  {
    return this->Options.smoothing * (this->State.points[i + 1] - this->State.points[i]).squaredNorm();
  }

  double stepAdagrad(std::size_t f)
  {
    const std::size_t begin = this->State.offsets[f];
    const std::size_t end = this->State.offsets[f + 1];
    double largest = 0.0;
    this->constrainEnds(f, this->Gradient[begin], this->Gradient[end - 1]);
    for (std::size_t i = begin; i < end; ++i)
    {
      const Eigen::Vector3d& gradient = this->Gradient[i];
      Eigen::Vector3d& squares = this->Velocity[i];
      squares += gradient.cwiseAbs2();
      const Eigen::Vector3d change = -this->Options.stepSize * gradient.cwiseQuotient((squares.array().sqrt() + 1e-12).matrix());
      this->State.points[i] += change;
      double moved = change.norm();
      if (this->Options.radiusTolerance > 0.0)
      {
        double& radiusSquares = this->RadiusVelocity[i];
        radiusSquares += this->RadiusGradient[i] * this->RadiusGradient[i];
        moved += this->changeRadius(i, -this->Options.stepSize * this->RadiusGradient[i] / (std::sqrt(radiusSquares) + 1e-12));
      }
      largest = std::max(largest, moved);
    }
    return largest;
  }

  /// Both ends of a fibre stay in their planes across the bundle's axis, so that fibres keep spanning the domain.
  void constrainEnds(std::size_t f, Eigen::Vector3d& first, Eigen::Vector3d& last) const
  {
    const Eigen::Vector3d& axis = this->Costs.boxOf(f).axis;
    first -= first.dot(axis) * axis;
    last -= last.dot(axis) * axis;
  }

  double changeRadius(std::size_t i, double change)
  {
    const double reference = this->ReferenceRadii[i];
    const double tolerance = this->Options.radiusTolerance;
    const double before = this->State.radii[i];
    double& radius = this->State.radii[i];
    radius = std::min(std::max(radius + change, reference * (1.0 - tolerance)), reference * (1.0 + tolerance));
    return std::abs(radius - before);
  }

  void copyToCapsules(std::size_t f)
  {
    const std::size_t begin = this->State.offsets[f];
    const std::size_t end = this->State.offsets[f + 1];
    for (std::size_t i = begin; i + 1 < end; ++i)
    {
      Capsule& body = this->Bodies.bodies[i - f];
      std::copy_n(this->State.points[i].data(), 3, body.p0);
      std::copy_n(this->State.points[i + 1].data(), 3, body.p1);
      body.r0 = this->State.radii[i];
      body.r1 = this->State.radii[i + 1];
    }
  }

  Fibres& State;
  const CapsuleOptimizerOptions& Options;
  int Threads;
  FibreCosts Costs;
  Capsules Bodies;
  std::vector<double> ReferenceRadii;
  NeighbourList Neighbours;
  std::vector<CapsuleOverlap> Overlaps;
  std::vector<Eigen::Vector3d> Gradient;
  std::vector<double> RadiusGradient;
  std::vector<double> Stiffness;
  std::vector<Eigen::Vector3d> Velocity; ///< for Adagrad the sums of squared gradients
  std::vector<double> RadiusVelocity;
  double MeanRadius = 1.0;
  double LargestDiameter = 0.0;
  double Relaxation = 1.0;
  double Reach = 0.0;
  double Moved = 0.0; ///< upper bound of how far anything moved or grew since the last search
  int StepsSinceSearch = 0;
  double PairEvaluations = 0.0;
  int Searches = 0;
  double EvaluationSeconds = 0.0;
  double SearchSeconds = 0.0;
};

std::string describe(const ConvergenceRow& row)
{
  std::ostringstream text;
  text.precision(3);
  text << "iteration " << row.iteration << ": largest penetration " << row.maximumPenetration << ", " << row.overlappingPairs
       << " pairs overlap";
  return text.str();
}

void requireNumber(const char* name, double value, double lowest, double highest, const char* expectation)
{
  if (!(value >= lowest && value <= highest))
  {
    std::ostringstream message;
    message << name << " is " << value << ": it must be " << expectation;
    throw InvalidInput(message.str());
  }
}

} // namespace

void validate(const CapsuleOptimizerOptions& options)
{
  constexpr double large = 1e12;
  requireNumber("MaximumIterations", options.maximumIterations, 0, large, "0 or more");
  requireNumber("OverlapTolerance", options.overlapTolerance, 1e-12, 0.5, "above 0 and at most 0.5");
  requireNumber("OverlapWeight", options.overlapWeight, 1e-12, large, "above 0");
  requireNumber("CurvatureWeight", options.weights.curvature, 0.0, large, "0 or more");
  requireNumber("LengthWeight", options.weights.length, 0.0, large, "0 or more");
  requireNumber("RadiusWeight", options.weights.radius, 0.0, large, "0 or more");
  requireNumber("CompactnessWeight", options.weights.compactness, 0.0, large, "0 or more");
  requireNumber("StepSize", options.stepSize, 1e-9, 10.0, "above 0 and at most 10");
  requireNumber("Momentum", options.momentum, 0.0, 0.999, "at least 0 and below 1");
  requireNumber("SafetyMargin", options.safetyMargin, 1.0, 1.2, "between 1 and 1.2");
  requireNumber("RadiusTolerance", options.radiusTolerance, 0.0, 0.5, "between 0 and 0.5");
  requireNumber("Smoothing", options.smoothing, 0.0, large, "0 or more");
  requireNumber("Relaxation", options.relaxation, 0.5, 1.0, "between 0.5 and 1");
  requireNumber("PackingLimit", options.packingLimit, 0.1, 1.0, "between 0.1 and 1");
  requireNumber("TimeBudget", options.timeBudget, 0.0, large, "0 (none) or more seconds");
}

OptimisationResult optimise(Fibres& fibres, const CapsuleOptimizerOptions& options, const Context& context)
{
  validate(options);
  validate(fibres);
  const Clock::time_point start = Clock::now();
  const int threads = context.threadCount();
  OptimisationResult result;
  {
    Descent descent(fibres, options, threads);
    std::vector<Eigen::Vector3d> bestPoints = fibres.points;
    std::vector<double> bestRadii = fibres.radii;
    double bestCost = std::numeric_limits<double>::infinity();
    for (int iteration = 0;; ++iteration)
    {
      ConvergenceRow row = descent.evaluate();
      row.iteration = iteration;
      row.seconds = secondsSince(start);
      result.convergence.push_back(row);
      if (row.overlapCost < bestCost || row.maximumPenetration <= options.overlapTolerance)
      {
        bestCost = row.overlapCost;
        bestPoints = fibres.points;
        bestRadii = fibres.radii;
      }
      if (iteration % 10 == 0)
      {
        context.report(std::min(0.99, double(iteration) / std::max(1, options.maximumIterations)), describe(row));
      }
      if (row.maximumPenetration <= options.overlapTolerance)
      {
        result.reason = StopReason::Converged;
        break;
      }
      if (iteration >= options.maximumIterations)
      {
        result.reason = StopReason::MaximumIterations;
        break;
      }
      if (context.stopRequested())
      {
        result.reason = StopReason::Stopped;
        break;
      }
      if (options.timeBudget > 0.0 && secondsSince(start) >= options.timeBudget)
      {
        result.reason = StopReason::TimeBudget;
        break;
      }
      descent.step();
    }
    descent.account(result);
    fibres.points = std::move(bestPoints);
    fibres.radii = std::move(bestRadii);
  }
  // The lists above reach only as far as the descent needs: what is handed back is measured afresh.
  OverlapReport report = measureOverlap(fibres, options.overlapTolerance, threads);
  result.maximumPenetration = std::max(0.0, report.largestPenetration);
  result.overlappingPairs = report.overlappingPairs;
  result.overlap = std::move(report.perPoint);
  return result;
}

} // namespace cactus
