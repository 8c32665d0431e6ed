// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/CapsuleOptimizer.h"

#include "base/Checkpoint.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Memory.h"
#include "fibres/Capsules.h"
#include "fibres/FibreOrder.h"
#include "optimiser/BundleBox.h"
#include "optimiser/NeighbourSearch.h"
#include "optimiser/OverlapCost.h"
#include "optimiser/OverlapReport.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
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

/// Largest step of a control point with momentum, as a multiple of its radius: fibres that push each other away at full speed
/// land in others, and every neighbour list is worthless at once.
constexpr double fastest = 0.065;

/// Without progress for so many iterations a descent has got stuck: progress is a cost, or a largest penetration, smaller by
/// this share than any before.
constexpr int patience = 200;
constexpr double progressShare = 0.01;

/// What a descent takes for a control point, with some fifty neighbours.
constexpr double bytesPerPoint = 1000.0;

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
    , Upper(options.method == DescentMethod::Momentum ? fibres.points.size() : 0)
    , Velocity(fibres.points.size(), Eigen::Vector3d::Zero())
    , RadiusVelocity(options.radiusTolerance > 0.0 ? fibres.points.size() : 0, 0.0)
    , Speed(fibres.points.size(), 0.0f)
    , Push(fibres.points.size(), 0.0f)
    , Displacement(fibres.points.size())
    , Allowance(fibres.points.size())
  {
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
    std::vector<char> exceeded(count);
#pragma omp parallel for num_threads(this->Threads) schedule(dynamic, 16)
    for (std::size_t f = 0; f < count; ++f)
    {
      exceeded[f] = this->Options.method == DescentMethod::Momentum ? this->stepMomentum(f) : this->stepAdagrad(f);
      this->copyToCapsules(f);
    }
    ++this->StepsSinceSearch;
    this->Exceeded = std::find(exceeded.begin(), exceeded.end(), true) != exceeded.end();
    if (this->Options.method == DescentMethod::Momentum)
    {
      this->Relaxation = std::max(1e-8, this->Relaxation * this->Options.relaxation);
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

  /// Whether the next evaluation searches for neighbours, so that the lists of now need not be kept.
  bool searchDue() const
  {
    return this->Neighbours.offsets.empty() || this->Exceeded;
  }

  /// Everything that what follows depends on.
  void save(CheckpointWriter& file) const
  {
    file.putAll(this->State.points);
    file.putAll(this->State.radii);
    file.putAll(this->Velocity);
    file.putAll(this->RadiusVelocity);
    file.putAll(this->Speed);
    file.putAll(this->Push);
    file.put(this->Relaxation);
    file.put(this->Slack);
    file.put(this->StepsSinceSearch);
    file.put(this->PairEvaluations);
    file.put(this->Searches);
    file.put(this->EvaluationSeconds);
    file.put(this->SearchSeconds);
    // The order of a list decides how its sums are rounded.
    file.put(static_cast<std::uint8_t>(this->searchDue()));
    if (!this->searchDue())
    {
      file.putAll(this->Neighbours.offsets);
      file.putAll(this->Neighbours.indices);
      file.putAll(this->Displacement);
      file.putAll(this->Allowance);
    }
  }

  void load(CheckpointReader& file)
  {
    const auto count = static_cast<std::int64_t>(this->State.points.size());
    file.getAll(this->State.points, count);
    file.getAll(this->State.radii, count);
    file.getAll(this->Velocity, count);
    file.getAll(this->RadiusVelocity, static_cast<std::int64_t>(this->RadiusVelocity.size()));
    file.getAll(this->Speed, count);
    file.getAll(this->Push, count);
    file.get(this->Relaxation);
    file.get(this->Slack);
    file.get(this->StepsSinceSearch);
    file.get(this->PairEvaluations);
    file.get(this->Searches);
    file.get(this->EvaluationSeconds);
    file.get(this->SearchSeconds);
    std::uint8_t exceeded = 0;
    file.get(exceeded);
    file.require(exceeded <= 1);
    this->Exceeded = exceeded == 1;
    if (!this->Exceeded)
    {
      file.getAll(this->Neighbours.offsets, static_cast<std::int64_t>(this->Bodies.size()) + 1);
      file.getAll(this->Neighbours.indices);
      file.getAll(this->Displacement, count);
      file.getAll(this->Allowance, count);
    }
    file.require(this->isSound());
    for (std::size_t f = 0; f < this->State.size(); ++f)
    {
      this->copyToCapsules(f);
    }
  }

  /// Whether a descent from the fibres that came in can have made these positions and radii.
  bool couldBe(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& radii) const
  {
    constexpr double farthest = 10.0 * limits::coordinate.highest; // from where fibres may start, no run gets so far
    const double tolerance = this->Options.radiusTolerance * (1.0 + 1e-9);
    bool good = true;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      // Written so that it does not hold for NaN.
      good = good && points[i].cwiseAbs().maxCoeff() <= farthest && points[i].allFinite() &&
             std::abs(radii[i] - this->ReferenceRadii[i]) <= tolerance * this->ReferenceRadii[i];
    }
    for (const std::uint32_t i : this->Bodies.first)
    {
      good = good && (points[i + 1] - points[i]).squaredNorm() > 0.0;
    }
    return good;
  }

private:
  /// Whether what was loaded is a state that a descent can be in: nothing in it leads out of an array or to no number.
  bool isSound() const
  {
    const auto isLength = [](float value) { return value >= 0.0f && std::isfinite(value); };
    const auto isFinite = [](double value) { return std::isfinite(value); };
    const auto all = [](const auto& values, const auto& good) { return std::all_of(values.begin(), values.end(), good); };
    const bool adagrad = this->Options.method == DescentMethod::Adagrad;
    return this->couldBe(this->State.points, this->State.radii) &&
           all(this->Velocity, [&](const auto& v) { return v.allFinite() && (!adagrad || v.minCoeff() >= 0.0); }) &&
           all(this->RadiusVelocity, [&](double v) { return isFinite(v) && (!adagrad || v >= 0.0); }) &&
           all(this->Speed, isLength) && all(this->Push, [](float value) { return value >= 0.0f; }) && this->Relaxation > 0.0 &&
           this->Relaxation <= 1.0 && this->Slack >= 0.02 && this->Slack <= 0.6 && this->StepsSinceSearch >= 0 &&
           this->Searches >= 0 && isFinite(this->PairEvaluations) && isFinite(this->EvaluationSeconds) &&
           isFinite(this->SearchSeconds) &&
           (this->Exceeded || (all(this->Displacement, [](const auto& d) { return d.allFinite(); }) &&
                                all(this->Allowance, isLength) && this->areNeighboursSound()));
  }

  bool areNeighboursSound() const
  {
    const std::vector<std::size_t>& offsets = this->Neighbours.offsets;
    const std::vector<std::uint32_t>& indices = this->Neighbours.indices;
    if (offsets.front() != 0 || offsets.back() != indices.size() || !std::is_sorted(offsets.begin(), offsets.end()))
    {
      return false;
    }
    for (std::size_t k = 0; k < this->Bodies.size(); ++k)
    {
      for (std::size_t n = offsets[k]; n < offsets[k + 1]; ++n)
      {
        if (indices[n] >= this->Bodies.size() || this->Bodies.fibre[indices[n]] == this->Bodies.fibre[k])
        {
          return false;
        }
      }
    }
    return true;
  }

  /// The lists reach a little further than contact and hold until something could have come further than foreseen.
  void refreshNeighbours()
  {
    if (!this->searchDue())
    {
      return;
    }
    // Each capsule reaches as far as it would come in so many steps at its present speed and with its present push, but for those
    // that will be hit suddenly at least by some share of its radius. A search costs about as much as two evaluations, a wide
    // list costs time in every step: that share follows from letting a list hold for some eleven steps.
    constexpr double foresight = 12.0;
    constexpr double pushes = 5.0;
    if (this->StepsSinceSearch > 0)
    {
      const double change = this->StepsSinceSearch < 9 ? 1.4 : this->StepsSinceSearch > 13 ? 0.75 : 1.0;
      this->Slack = std::min(std::max(change * this->Slack, 0.02), 0.6);
    }
    const double margin = this->Options.safetyMargin - 1.0;
    std::vector<float> reach(this->Bodies.size());
#pragma omp parallel for num_threads(this->Threads) schedule(static)
    for (std::size_t i = 0; i < this->Allowance.size(); ++i)
    {
      const double radius = this->State.radii[i];
      const double foreseen = foresight * std::min(double(this->Speed[i]) + pushes * double(this->Push[i]), fastest * radius);
      this->Allowance[i] = static_cast<float>(std::max(foreseen, this->Slack * radius));
      this->Displacement[i].setZero();
    }
#pragma omp parallel for num_threads(this->Threads) schedule(static)
    for (std::size_t k = 0; k < reach.size(); ++k)
    {
      const std::size_t i = this->Bodies.first[k];
      const double radius = std::max(this->State.radii[i], this->State.radii[i + 1]);
      reach[k] = std::max(this->Allowance[i], this->Allowance[i + 1]) + static_cast<float>(margin * radius * 1.0001);
    }
    const Clock::time_point start = Clock::now();
    findNeighbours(this->Bodies, reach, this->Threads, this->Neighbours);
    this->SearchSeconds += secondsSince(start);
    ++this->Searches;
    this->Exceeded = false;
    this->StepsSinceSearch = 0;
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

  /// Displaces a control point, and says whether it has come further than the neighbour lists allow.
  bool move(std::size_t i, const Eigen::Vector3d& by, double growth)
  {
    this->State.points[i] += by;
    this->Speed[i] = static_cast<float>(by.norm());
    Eigen::Vector4f& total = this->Displacement[i];
    total.head<3>() += by.cast<float>();
    total[3] += static_cast<float>(std::abs(growth));
    // Growth counts twice: for the radius and, generously, for the margin.
    return total.head<3>().norm() + 2.0f * total[3] > this->Allowance[i];
  }

  bool stepMomentum(std::size_t f)
  {
    const std::size_t begin = this->State.offsets[f];
    const std::size_t end = this->State.offsets[f + 1];
    this->smoothGradient(f);
    for (std::size_t i = begin; i < end; ++i)
    {
      Eigen::Vector3d& velocity = this->Velocity[i];
      velocity = this->Options.momentum * velocity - this->Options.stepSize * this->Gradient[i];
      const double speed = velocity.norm();
      const double limit = fastest * this->State.radii[i];
      if (speed > limit)
      {
        velocity *= limit / speed;
      }
    }
    this->constrainEnds(f, this->Velocity[begin], this->Velocity[end - 1]);
    bool exceeded = false;
    for (std::size_t i = begin; i < end; ++i)
    {
      this->Push[i] = static_cast<float>(this->Options.stepSize * this->Gradient[i].norm());
      double growth = 0.0;
      if (this->Options.radiusTolerance > 0.0)
      {
        double& radiusVelocity = this->RadiusVelocity[i];
        const double radiusStiffness = this->diagonal(i) + 2.0 * this->Options.weights.radius;
        radiusVelocity =
          this->Options.momentum * radiusVelocity - this->Options.stepSize / radiusStiffness * this->RadiusGradient[i];
        growth = this->changeRadius(i, radiusVelocity);
      }
      exceeded |= this->move(i, this->Velocity[i], growth);
    }
    return exceeded;
  }

  /// Replaces the gradient of a fibre by M⁻¹ · gradient, with M the diagonal stiffness plus a stiff thread along the fibre: the
  /// fibre moves as a whole where its neighbours push it as a whole, instead of kinking control point by control point.
  void smoothGradient(std::size_t f)
  {
    const std::size_t begin = this->State.offsets[f];
    const std::size_t end = this->State.offsets[f + 1];
    double* upper = this->Upper.data() + begin;
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

  bool stepAdagrad(std::size_t f)
  {
    const std::size_t begin = this->State.offsets[f];
    const std::size_t end = this->State.offsets[f + 1];
    bool exceeded = false;
    this->constrainEnds(f, this->Gradient[begin], this->Gradient[end - 1]);
    for (std::size_t i = begin; i < end; ++i)
    {
      const Eigen::Vector3d& gradient = this->Gradient[i];
      Eigen::Vector3d& squares = this->Velocity[i];
      squares += gradient.cwiseAbs2();
      const Eigen::Vector3d change = -this->Options.stepSize * gradient.cwiseQuotient((squares.array().sqrt() + 1e-12).matrix());
      double growth = 0.0;
      if (this->Options.radiusTolerance > 0.0)
      {
        double& radiusSquares = this->RadiusVelocity[i];
        radiusSquares += this->RadiusGradient[i] * this->RadiusGradient[i];
        growth = this->changeRadius(i, -this->Options.stepSize * this->RadiusGradient[i] / (std::sqrt(radiusSquares) + 1e-12));
      }
      exceeded |= this->move(i, change, growth);
    }
    return exceeded;
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
    return radius - before;
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
  std::vector<double> Upper;             ///< room for the elimination in smoothGradient
  std::vector<Eigen::Vector3d> Velocity; ///< for Adagrad the sums of squared gradients
  std::vector<double> RadiusVelocity;
  double Relaxation = 1.0;
  std::vector<float> Speed;                  ///< length of the last step (µm)
  std::vector<float> Push;                   ///< what the gradient added to it
  std::vector<Eigen::Vector4f> Displacement; ///< of each control point since the last search, and the sum of its radius's changes
  std::vector<float> Allowance;              ///< how far that may go before the next search
  bool Exceeded = false;                     ///< whether it has gone further anywhere
  double Slack = 0.3;                        ///< least allowance, as a multiple of the radius
  int StepsSinceSearch = 0;
  double PairEvaluations = 0.0;
  int Searches = 0;
  double EvaluationSeconds = 0.0;
  double SearchSeconds = 0.0;
};

std::string describe(const ConvergenceRow& row)
{
  TextStream text;
  text.precision(3);
  text << "iteration " << row.iteration << ": largest penetration " << row.maximumPenetration << ", " << row.overlappingPairs
       << " pairs overlap";
  return text.str();
}

/// How far a run has come, from 0 to 0.99: by its iterations or by the logarithm of the largest penetration, whichever is more.
double progressOf(const ConvergenceRow& row, double firstPenetration, const CapsuleOptimizerOptions& options)
{
  const double byIterations = double(row.iteration) / std::max(1, options.maximumIterations);
  const double toGo = std::log(std::max(row.maximumPenetration / options.overlapTolerance, 1.0));
  const double all = std::log(std::max(firstPenetration / options.overlapTolerance, 2.0));
  return std::clamp(std::max(byIterations, 1.0 - toGo / all), 0.0, 0.99);
}

/// What the result depends on: the fibres that come in and all parameters but those that only say when to stop.
std::uint64_t fingerprintOf(const Fibres& fibres, const CapsuleOptimizerOptions& options)
{
  Fingerprint print;
  for (const double value : { options.overlapTolerance, options.overlapWeight, options.weights.curvature, options.weights.length,
         options.weights.radius, options.weights.compactness, options.stepSize, options.momentum, options.smoothing,
         options.relaxation, options.packingLimit, options.safetyMargin, options.radiusTolerance })
  {
    print.add(value);
  }
  print.add(static_cast<int>(options.method));
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    print.add(fibres.fibreIds[f]);
    print.add(fibres.bundleIds[f]);
    print.add(fibres.offsets[f + 1]);
  }
  for (std::size_t i = 0; i < fibres.points.size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      print.add(fibres.points[i][axis]);
    }
    print.add(fibres.radii[i]);
  }
  return print.value();
}

/// A descent and all that its caller knows of it: what has to be written down to go on later.
struct Run
{
  Run(Fibres& fibres, const CapsuleOptimizerOptions& options, int threads)
    : state(fibres)
    , descent(fibres, options, threads)
    , bestPoints(fibres.points)
    , bestRadii(fibres.radii)
  {
  }

  /// Notes the state that was just measured.
  void note(const ConvergenceRow& row, double tolerance)
  {
    if (row.overlapCost < this->bestCost || row.maximumPenetration <= tolerance)
    {
      this->bestCost = row.overlapCost;
      this->bestPoints = this->state.points;
      this->bestRadii = this->state.radii;
    }
    constexpr double share = 1.0 - progressShare;
    if (row.overlapCost < share * this->lowestCost || row.maximumPenetration < share * this->lowestPenetration)
    {
      this->lastProgress = row.iteration;
      this->lowestCost = std::min(this->lowestCost, row.overlapCost);
      this->lowestPenetration = std::min(this->lowestPenetration, row.maximumPenetration);
    }
  }

  void save(const std::string& path, std::uint64_t fingerprint) const
  {
    CheckpointWriter file(path, { fingerprint, this->iteration });
    file.put(this->seconds);
    file.put(this->bestCost);
    file.put(this->lowestCost);
    file.put(this->lowestPenetration);
    file.put(this->lastProgress);
    for (const ConvergenceRow& row : this->rows)
    {
      visit(row, [&](const auto& value) { file.put(value); });
    }
    file.putAll(this->bestPoints);
    file.putAll(this->bestRadii);
    this->descent.save(file);
    file.commit();
  }

  void load(const std::string& path, std::uint64_t fingerprint)
  {
    const auto count = static_cast<std::int64_t>(this->state.points.size());
    CheckpointReader file(path, fingerprint);
    file.require(file.header().iteration >= 0 && file.header().iteration <= std::numeric_limits<int>::max());
    this->iteration = static_cast<int>(file.header().iteration);
    file.get(this->seconds);
    file.get(this->bestCost);
    file.get(this->lowestCost);
    file.get(this->lowestPenetration);
    file.get(this->lastProgress);
    file.require(std::isfinite(this->seconds) && this->bestCost >= 0.0 && this->lowestCost >= 0.0 &&
                 this->lowestPenetration >= 0.0 && this->lastProgress >= 0 && this->lastProgress <= this->iteration);
    for (int i = 0; i < this->iteration; ++i)
    {
      ConvergenceRow row;
      visit(row, [&](auto& value) { file.get(value); });
      file.require(row.iteration == i && std::isfinite(row.overlapCost) && row.maximumPenetration >= 0.0);
      this->rows.push_back(row);
    }
    file.getAll(this->bestPoints, count);
    file.getAll(this->bestRadii, count);
    file.require(this->descent.couldBe(this->bestPoints, this->bestRadii));
    this->descent.load(file);
    file.finish();
  }

  /// One by one: a row as a whole has a gap.
  template <typename Row, typename Visitor>
  static void visit(Row& row, const Visitor& visitor)
  {
    visitor(row.iteration);
    visitor(row.overlapCost);
    visitor(row.maximumPenetration);
    visitor(row.overlappingPairs);
    visitor(row.curvatureCost);
    visitor(row.lengthCost);
    visitor(row.radiusCost);
    visitor(row.compactnessCost);
    visitor(row.seconds);
  }

  Fibres& state;
  Descent descent;
  int iteration = 0;    ///< the next one
  double seconds = 0.0; ///< before this run
  std::vector<ConvergenceRow> rows;
  std::vector<Eigen::Vector3d> bestPoints;
  std::vector<double> bestRadii;
  double bestCost = std::numeric_limits<double>::infinity();
  double lowestCost = std::numeric_limits<double>::infinity(); ///< at the last step forward
  double lowestPenetration = std::numeric_limits<double>::infinity();
  int lastProgress = 0;
};

/// Where a run is written down every now and then, and what is there already.
class Checkpoints
{
public:
  /// Throws where the file is there and not a checkpoint of this run, and where it cannot be written.
  Checkpoints(const Fibres& fibres, const CapsuleOptimizerOptions& options)
    : Path(options.checkpointFile)
    , Interval(options.checkpointInterval)
    , Latest(Clock::now())
  {
    if (!this->Path.empty())
    {
      this->Print = fingerprintOf(fibres, options);
      const auto found = findCheckpoint(this->Path, this->Print);
      this->Reached = found ? found->iteration : -1;
      // Goes away again unless it is committed.
      const CheckpointWriter attempt(this->Path, { this->Print, 0 });
    }
  }

  bool found() const { return this->Reached >= 0; }

  void load(Run& run) const { run.load(this->Path, this->Print); }

  bool due(const Run& run) const
  {
    return !this->Path.empty() &&
           ((!this->found() && !this->Written) || (run.descent.searchDue() && secondsSince(this->Latest) >= this->Interval));
  }

  /// Writes the run down, unless what is there has come further (the same run, from the beginning once more). That a later
  /// checkpoint cannot be written is no reason to give up a long run: it is noted.
  void write(const Run& run, OptimisationResult& result)
  {
    this->Latest = Clock::now();
    if (this->Path.empty() || run.iteration < this->Reached)
    {
      return;
    }
    try
    {
      run.save(this->Path, this->Print);
      result.checkpointFailure.clear();
    }
    catch (const Error& error)
    {
      if (!this->Written && !this->found())
      {
        throw;
      }
      result.checkpointFailure = error.what();
    }
    this->Written = true;
  }

private:
  std::string Path;
  double Interval;
  Clock::time_point Latest;
  std::uint64_t Print = 0;
  std::int64_t Reached = -1; ///< iteration of the checkpoint that was there; −1 for none
  bool Written = false;
};

/// Whether the state that was just measured is the last one, and why.
bool shouldStop(const Run& run, const ConvergenceRow& row, const CapsuleOptimizerOptions& options, const Context& context,
  double seconds, StopReason& reason)
{
  if (row.maximumPenetration <= options.overlapTolerance)
  {
    reason = StopReason::Converged;
    return true;
  }
  if (row.iteration >= options.maximumIterations)
  {
    reason = StopReason::MaximumIterations;
    return true;
  }
  if (row.iteration - run.lastProgress >= patience)
  {
    reason = StopReason::Stagnated;
    return true;
  }
  if (context.stopRequested())
  {
    reason = StopReason::Stopped;
    return true;
  }
  if (options.timeBudget > 0.0 && context.agreed(seconds >= options.timeBudget))
  {
    reason = StopReason::TimeBudget;
    return true;
  }
  return false;
}

/// Throws InvalidInput for a fibre whose capsules are so much shorter than they are thick that the neighbour search, which passes
/// by those of the fibre itself, would not come to an end.
void requireSegmentsToSearch(const Fibres& fibres)
{
  constexpr double mostCandidates = 3e8;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    double length = 0.0;
    double radius = 0.0;
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      length += i > fibres.offsets[f] ? (fibres.points[i] - fibres.points[i - 1]).norm() : 0.0;
      radius = std::max(radius, fibres.radii[i]);
    }
    const auto count = static_cast<double>(fibres.pointCount(f));
    const double spacing = length / (count - 1.0);
    if (count * std::min(count, radius / spacing) > mostCandidates)
    {
      throw InvalidInput(text("fibre ", fibres.fibreIds[f], " (cell ", f, ") has ", fibres.pointCount(f), " control points, ",
        spacing, " µm apart with a Radius of up to ", radius, " µm: resample it to a spacing of about its radius"));
    }
  }
}

} // namespace

OptimisationResult optimise(Fibres& fibres, const CapsuleOptimizerOptions& options, const Context& context,
  const std::function<void(int iteration, const Fibres&)>& observe)
{
  validate(options);
  validate(fibres);
  requireSegmentsToSearch(fibres);
  requireMemory(bytesPerPoint * static_cast<double>(fibres.points.size()),
    text("an optimisation of ", fibres.size(), " fibres with ", fibres.points.size(), " control points"),
    "use fewer fibres, or a larger spacing of their control points");
  const Clock::time_point start = Clock::now();
  const int threads = context.threadCount();
  Checkpoints checkpoints(fibres, options);
  OptimisationResult result;
  const FibreOrder order(fibres);
  Fibres state = order.ordered(fibres);
  // A state without overlap is left alone.
  const bool apart = measureOverlap(state, options.overlapTolerance, threads).overlappingPairs == 0;
  if (!apart && options.weights.compactness > 0.0)
  {
    spreadBundles(state, options.packingLimit);
  }
  {
    Run run(state, options, threads);
    if (options.resume && checkpoints.found())
    {
      checkpoints.load(run);
    }
    double progress = 0.0;
    for (;; ++run.iteration)
    {
      if (checkpoints.due(run))
      {
        checkpoints.write(run, result);
      }
      ConvergenceRow row = run.descent.evaluate();
      row.iteration = run.iteration;
      row.seconds = run.seconds + secondsSince(start);
      run.note(row, options.overlapTolerance);
      if (observe)
      {
        order.restore(state.points, fibres.points);
        order.restore(state.radii, fibres.radii);
        observe(run.iteration, fibres);
      }
      if (run.iteration % 10 == 0)
      {
        const double first = run.rows.empty() ? row.maximumPenetration : run.rows.front().maximumPenetration;
        progress = std::max(progress, progressOf(row, first, options));
        context.report(progress, describe(row));
      }
      const bool last = shouldStop(run, row, options, context, secondsSince(start), result.reason);
      if (last)
      {
        // Before this row is added: a run that goes on from here measures this state again.
        run.seconds = row.seconds;
        checkpoints.write(run, result);
      }
      run.rows.push_back(row);
      if (last)
      {
        break;
      }
      run.descent.step();
    }
    run.descent.account(result);
    result.convergence = std::move(run.rows);
    state.points = std::move(run.bestPoints);
    state.radii = std::move(run.bestRadii);
  }
  // The lists above reach only as far as the descent needs: what is handed back is measured afresh.
  const OverlapReport report = measureOverlap(state, options.overlapTolerance, threads);
  result.maximumPenetration = std::max(0.0, report.largestPenetration);
  result.overlappingPairs = report.overlappingPairs;
  order.restore(report.perPoint, result.overlap);
  order.restore(state.points, fibres.points);
  order.restore(state.radii, fibres.radii);
  return result;
}

} // namespace cactus
