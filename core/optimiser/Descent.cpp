// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/Descent.h"

#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Parallel.h"
#include "optimiser/OverlapCost.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cactus
{

namespace
{

/// Largest step of a control point with momentum, as a multiple of its radius: with larger ones, fibres that push each other
/// apart land in others, and neighbour lists are useless at once.
constexpr double largestStep = 0.065;

/// Once there are fewer overlapping pairs than this fraction of the capsules, fibres are in place, and the costs that shape them
/// fade 2.5 times as fast. Steps become shorter by this factor: once the costs that shape fibres have faded, nothing but contacts
/// holds them, and long steps let those in contact swing into others again.
constexpr double fewOverlaps = 0.05;
constexpr double settlingStep = 0.6;

/// Fewer control points suffice until then, or until the costs that shape fibres have faded to this. With 0.001, some fibres that
/// cross at 25° stayed overlapping, since too little of these costs was left to lay out all control points.
constexpr double laidOutRelaxation = 0.01;

/// Numbers of fibres, and of control points or capsules, that one thread processes at a time.
constexpr std::size_t fibresTogether = 16;
constexpr std::size_t pointsTogether = 4096;

/// Bounds of DescentState::leastAllowance.
constexpr double smallestLeastAllowance = 0.02;
constexpr double largestLeastAllowance = 0.6;

class Stopwatch
{
public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count(); }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

} // namespace

Descent::Descent(
  Fibres& fibres, const FibreShares& shares, std::vector<BundleBox> boxes, const CapsuleOptimizerOptions& options, int threads)
  : State(fibres, options.radiusTolerance > 0.0)
  , Shares(shares)
  , Options(options)
  , Threads(threads)
  , Costs(fibres, options.weights, std::move(boxes))
  , Bodies(fibres, shares)
  , ReferenceRadii(fibres.radii)
  , Gradient(fibres.points.size())
  , RadiusGradient(fibres.points.size())
  , Stiffness(fibres.points.size())
  , Upper(options.method == DescentMethod::Momentum ? fibres.points.size() : 0)
{
  for (std::size_t f = 0; fibres.domain.periodic[2] && f < fibres.size(); ++f)
  {
    this->Periods.push_back(periodOf(fibres, f));
  }
  this->Closing.resize(this->Periods.empty() ? 0 : this->Upper.size());
}

ConvergenceRow Descent::evaluate(const std::function<Moment()>& now, Moment& moment)
{
  this->refreshNeighbours();
  const Stopwatch watch;
  const OverlapParts overlap = this->Bodies.evaluate(
    this->State.neighbours, this->Options.safetyMargin, this->Options.overlapTolerance, this->Threads, this->Overlaps);
  this->State.effort.evaluationSeconds += watch.seconds();
  const Fibres& fibres = this->State.fibres;
  std::vector<FibreCostTotals> perFibre(fibres.size());
  const FibreGradients gradients{ this->Gradient, this->RadiusGradient, this->Stiffness };
  parallelForInBlocks(fibres.size(), fibresTogether, this->Threads,
    [&](std::size_t f)
    {
      this->gatherOverlap(f);
      perFibre[f] = this->Costs.add(fibres, f, this->State.relaxation, gradients);
    });
  const auto pairs = static_cast<std::uint64_t>(this->State.neighbours.indices.size());
  return this->sumUp(this->Shares.sharing().exchange(bytesOf(now(), pairs, overlap, perFibre)), moment);
}

/// Returns the sums over all processes, in the order of a single process.
ConvergenceRow Descent::sumUp(const std::vector<std::string>& told, Moment& moment)
{
  ConvergenceRow row;
  OverlapSum sum;
  for (std::size_t process = 0; process < told.size(); ++process)
  {
    Moment theirs;
    std::uint64_t pairs = 0;
    OverlapParts overlap;
    std::vector<FibreCostTotals> perFibre;
    getAll(told[process], theirs, pairs, overlap, perFibre);
    moment = process == 0 ? theirs : Moment{ moment.seconds, moment.wantsStop || theirs.wantsStop };
    this->State.effort.pairEvaluations += static_cast<double>(pairs);
    sum.add(overlap);
    for (const FibreCostTotals& totals : perFibre)
    {
      row.curvatureCost += totals.curvature;
      row.lengthCost += totals.length;
      row.radiusCost += totals.radius;
      row.compactnessCost += totals.compactness;
    }
  }
  const OverlapTotals overlap = sum.totals();
  row.overlapCost = this->Options.overlapWeight * overlap.cost;
  row.maximumPenetration = std::max(0.0, overlap.penetration);
  row.overlappingPairs = overlap.overlappingPairs;
  this->OverlappingShare = static_cast<double>(overlap.overlappingPairs) / static_cast<double>(this->Shares.capsuleCount());
  return row;
}

void Descent::step()
{
  const bool momentum = this->Options.method == DescentMethod::Momentum;
  std::vector<char> exceeded(this->State.fibres.size());
  parallelForInBlocks(exceeded.size(), fibresTogether, this->Threads,
    [&](std::size_t f)
    {
      exceeded[f] = momentum ? this->stepMomentum(f) : this->stepAdagrad(f);
      this->closePeriod(f);
      this->Bodies.take(this->State.fibres, f);
    });
  ++this->State.stepsSinceSearch;
  this->State.exceeded = this->Bodies.update(
    this->State.fibres, this->Options.radiusTolerance > 0.0, std::find(exceeded.begin(), exceeded.end(), true) != exceeded.end());
  if (momentum)
  {
    const double once = this->Options.relaxation;
    const double factor = this->OverlappingShare < fewOverlaps ? once * once * std::sqrt(once) : once;
    this->State.relaxation = std::max(1e-8, this->State.relaxation * factor);
  }
  this->requireFinite();
}

/// Steps are bounded, but quotients by the length of a vanishing segment are not.
void Descent::requireFinite() const
{
  const std::vector<Eigen::Vector3d>& points = this->State.fibres.points;
  if (!std::all_of(points.begin(), points.end(), [](const Eigen::Vector3d& point) { return point.allFinite(); }))
  {
    throw InvalidInput(
      this->Options.resume
        ? text("CheckpointFile ", this->Options.checkpointFile,
            " holds a state from which fibres leave all bounds, and is kept: remove it, or name another file")
        : std::string("fibres leave all bounds, since some of their control points nearly coincide: resample them"));
  }
}

/// Lists reach a little further than contact, and are valid until a control point may have moved further than foreseen.
void Descent::refreshNeighbours()
{
  DescentState& state = this->State;
  if (!state.searchDue())
  {
    return;
  }
  this->setAllowances();
  const double margin = this->Options.safetyMargin - 1.0;
  std::vector<float> reach(this->Bodies.own().size());
  parallelForInBlocks(reach.size(), pointsTogether, this->Threads,
    [&](std::size_t k)
    {
      const std::size_t i = this->Bodies.pointOf(k);
      const double radius = std::max(state.fibres.radii[i], state.fibres.radii[i + 1]);
      reach[k] = std::max(state.allowance[i], state.allowance[i + 1]) + static_cast<float>(margin * radius * 1.0001);
    });
  const Stopwatch watch;
  this->Bodies.findNeighbours(state.fibres, reach, this->Threads, state.neighbours);
  state.effort.searchSeconds += watch.seconds();
  ++state.effort.neighbourSearches;
  state.exceeded = false;
  state.stepsSinceSearch = 0;
}

/// Allows each control point the distance of so many steps at its present speed and push, and at least a fraction of its radius,
/// since another may hit it suddenly. A search costs about as much as two evaluations, and a wide list costs time in every step:
/// the fraction is adapted so that a list lasts for some eleven steps.
void Descent::setAllowances()
{
  DescentState& state = this->State;
  constexpr double foreseenSteps = 12.0;
  constexpr double foreseenPushes = 5.0;
  if (state.stepsSinceSearch > 0)
  {
    const double change = state.stepsSinceSearch < 9 ? 1.4 : state.stepsSinceSearch > 13 ? 0.75 : 1.0;
    state.leastAllowance = std::min(std::max(change * state.leastAllowance, smallestLeastAllowance), largestLeastAllowance);
  }
  parallelForInBlocks(state.allowance.size(), pointsTogether, this->Threads,
    [&](std::size_t i)
    {
      const double radius = state.fibres.radii[i];
      const double foreseen =
        foreseenSteps * std::min(double(state.speed[i]) + foreseenPushes * double(state.push[i]), largestStep * radius);
      state.allowance[i] = static_cast<float>(std::max(foreseen, state.leastAllowance * radius));
      state.displacement[i].setZero();
    });
}

/// Sums the contributions of the two capsules at each control point.
void Descent::gatherOverlap(std::size_t f)
{
  const std::size_t begin = this->State.fibres.offsets[f];
  const std::size_t end = this->State.fibres.offsets[f + 1];
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

/// Displaces a control point, and returns whether it has moved further than the neighbour lists allow.
bool Descent::move(std::size_t i, const Eigen::Vector3d& by, double growth)
{
  this->State.fibres.points[i] += by;
  this->State.speed[i] = static_cast<float>(by.norm());
  Eigen::Vector4f& total = this->State.displacement[i];
  total.head<3>() += by.cast<float>();
  total[3] += static_cast<float>(std::abs(growth));
  // Growth counts twice: for the radius and, generously, for the margin.
  return total.head<3>().norm() + 2.0f * total[3] > this->State.allowance[i];
}

bool Descent::stepMomentum(std::size_t f)
{
  this->Periods.empty() ? this->smoothGradient(f) : this->smoothGradientAround(f);
  this->accelerate(f);
  bool exceeded = false;
  for (std::size_t i = this->State.fibres.offsets[f]; i < this->State.fibres.offsets[f + 1]; ++i)
  {
    this->State.push[i] = static_cast<float>(this->stepSize() * this->Gradient[i].norm());
    const double growth = this->Options.radiusTolerance > 0.0 ? this->changeRadiusWithMomentum(i) : 0.0;
    exceeded |= this->move(i, this->State.velocity[i], growth);
  }
  return exceeded;
}

void Descent::accelerate(std::size_t f)
{
  const std::size_t begin = this->State.fibres.offsets[f];
  const std::size_t end = this->State.fibres.offsets[f + 1];
  for (std::size_t i = begin; i < end; ++i)
  {
    Eigen::Vector3d& velocity = this->State.velocity[i];
    velocity = this->Options.momentum * velocity - this->stepSize() * this->Gradient[i];
    const double speed = velocity.norm();
    const double limit = largestStep * this->State.fibres.radii[i];
    if (speed > limit)
    {
      velocity *= limit / speed;
    }
  }
  this->constrainEnds(f, this->State.velocity[begin], this->State.velocity[end - 1]);
}

double Descent::changeRadiusWithMomentum(std::size_t i)
{
  double& velocity = this->State.radiusVelocity[i];
  const double stiffness = this->stiffnessOfPoint(i) + 2.0 * this->Options.weights.radius;
  velocity = this->Options.momentum * velocity - this->stepSize() / stiffness * this->RadiusGradient[i];
  return this->changeRadius(i, velocity);
}

/// Replaces the gradient of a fibre by M⁻¹ · gradient, with M the diagonal stiffness plus a stiff thread along the fibre: if its
/// neighbours push the fibre as a whole, it moves as a whole, instead of kinking at single control points.
void Descent::smoothGradient(std::size_t f)
{
  const std::size_t begin = this->State.fibres.offsets[f];
  const std::size_t end = this->State.fibres.offsets[f + 1];
  double* upper = this->Upper.data() + begin;
  for (std::size_t i = begin; i < end; ++i)
  {
    const double before = i > begin ? this->stiffnessOfThread(i - 1) : 0.0;
    const double after = i + 1 < end ? this->stiffnessOfThread(i) : 0.0;
    double diagonal = this->stiffnessOfPoint(i) + before + after;
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

/// Does the same for the middle period of a fibre that repeats, whose last control point is followed by the first one.
void Descent::smoothGradientAround(std::size_t f)
{
  const std::size_t first = this->firstOfPeriod(f);
  const std::size_t last = this->Periods[f].points - 1;
  Eigen::Vector3d* gradient = this->Gradient.data() + first;
  double* upper = this->Upper.data() + first;
  double* closing = this->Closing.data() + first; // by how much the last control point moves each
  const auto thread = [&](std::size_t i) { return this->stiffnessOfThread(first + i); };
  const double around = thread(last);
  for (std::size_t i = 0; i < last; ++i)
  {
    const double before = i > 0 ? thread(i - 1) : around;
    double diagonal = this->stiffnessOfPoint(first + i) + before + thread(i);
    closing[i] = (i == 0 ? around : 0.0) + (i + 1 == last ? thread(i) : 0.0);
    if (i > 0)
    {
      diagonal += before * upper[i - 1];
      gradient[i] += before * gradient[i - 1];
      closing[i] += before * closing[i - 1];
    }
    upper[i] = i + 1 < last ? -thread(i) / diagonal : 0.0;
    gradient[i] /= diagonal;
    closing[i] /= diagonal;
  }
  for (std::size_t i = last - 1; i > 0; --i)
  {
    gradient[i - 1] -= upper[i - 1] * gradient[i];
    closing[i - 1] -= upper[i - 1] * closing[i];
  }
  const double before = thread(last - 1);
  const double diagonal = this->stiffnessOfPoint(first + last) + before * (1.0 - closing[last - 1]) + around * (1.0 - closing[0]);
  gradient[last] = (gradient[last] + before * gradient[last - 1] + around * gradient[0]) / diagonal;
  for (std::size_t i = 0; i < last; ++i)
  {
    gradient[i] += closing[i] * gradient[last];
  }
}

/// Returns the first control point of the middle period of a fibre that repeats.
std::size_t Descent::firstOfPeriod(std::size_t f) const
{
  const std::size_t begin = this->State.fibres.offsets[f];
  return begin + (this->State.fibres.offsets[f + 1] - begin - this->Periods[f].points) / 2;
}

double Descent::stepSize() const
{
  return (this->OverlappingShare < fewOverlaps ? settlingStep : 1.0) * this->Options.stepSize;
}

/// Never zero, so that a point that no other fibre touches stays in place.
double Descent::stiffnessOfPoint(std::size_t i) const
{
  return this->Stiffness[i] + 1e-3 * this->State.fibres.radii[i] * this->State.fibres.radii[i];
}

/// Returns the stiffness between a control point and the next.
double Descent::stiffnessOfThread(std::size_t i) const
{
  return this->Options.smoothing * (this->State.fibres.points[i + 1] - this->State.fibres.points[i]).squaredNorm();
}

bool Descent::stepAdagrad(std::size_t f)
{
  const std::size_t begin = this->State.fibres.offsets[f];
  const std::size_t end = this->State.fibres.offsets[f + 1];
  bool exceeded = false;
  this->constrainEnds(f, this->Gradient[begin], this->Gradient[end - 1]);
  for (std::size_t i = begin; i < end; ++i)
  {
    const Eigen::Vector3d& gradient = this->Gradient[i];
    Eigen::Vector3d& squares = this->State.velocity[i];
    squares += gradient.cwiseAbs2();
    const Eigen::Vector3d change = -this->Options.stepSize * gradient.cwiseQuotient((squares.array().sqrt() + 1e-12).matrix());
    const double growth = this->Options.radiusTolerance > 0.0 ? this->changeRadiusWithAdagrad(i) : 0.0;
    exceeded |= this->move(i, change, growth);
  }
  return exceeded;
}

double Descent::changeRadiusWithAdagrad(std::size_t i)
{
  double& squares = this->State.radiusVelocity[i];
  squares += this->RadiusGradient[i] * this->RadiusGradient[i];
  return this->changeRadius(i, -this->Options.stepSize * this->RadiusGradient[i] / (std::sqrt(squares) + 1e-12));
}

/// Repeats the middle period of a fibre that is periodic along z in its other control points.
void Descent::closePeriod(std::size_t f)
{
  if (this->Periods.empty())
  {
    return;
  }
  const FibrePeriod& period = this->Periods[f];
  const std::size_t begin = this->State.fibres.offsets[f];
  const std::size_t end = this->State.fibres.offsets[f + 1];
  const std::size_t first = this->firstOfPeriod(f);
  const auto repeat = [&](std::size_t from, std::size_t to, const Eigen::Vector3d& shift)
  {
    this->State.fibres.points[to] = this->State.fibres.points[from] + shift;
    this->State.fibres.radii[to] = this->State.fibres.radii[from];
    this->State.velocity[to] = this->State.velocity[from];
    this->State.speed[to] = this->State.speed[from];
    this->State.push[to] = this->State.push[from];
    this->State.displacement[to] = this->State.displacement[from];
    if (!this->State.radiusVelocity.empty())
    {
      this->State.radiusVelocity[to] = this->State.radiusVelocity[from];
    }
  };
  for (std::size_t i = first; i-- > begin;)
  {
    repeat(i + period.points, i, -period.shift);
  }
  for (std::size_t i = first + period.points; i < end; ++i)
  {
    repeat(i - period.points, i, period.shift);
  }
}

/// Keeps both ends of a fibre in their planes across the bundle's axis, so that fibres keep spanning the domain. The ends of one
/// that repeats along z are copies, see closePeriod().
void Descent::constrainEnds(std::size_t f, Eigen::Vector3d& first, Eigen::Vector3d& last) const
{
  const Eigen::Vector3d& axis = this->Costs.boxOf(f).axis;
  first -= first.dot(axis) * axis;
  last -= last.dot(axis) * axis;
}

/// Changes a radius within its tolerance, and returns the change.
double Descent::changeRadius(std::size_t i, double change)
{
  const double reference = this->ReferenceRadii[i];
  const double tolerance = this->Options.radiusTolerance;
  double& radius = this->State.fibres.radii[i];
  const double before = radius;
  radius = std::min(std::max(radius + change, reference * (1.0 - tolerance)), reference * (1.0 + tolerance));
  return radius - before;
}

bool Descent::isLaidOut() const
{
  return this->OverlappingShare < fewOverlaps || this->State.relaxation < laidOutRelaxation;
}

void Descent::takeOver(const DescentState& coarse, std::vector<Eigen::Vector3d> points, std::vector<Eigen::Vector3d> velocity)
{
  this->State.fibres.points = std::move(points);
  this->State.velocity = std::move(velocity);
  this->State.relaxation = coarse.relaxation;
  this->State.effort = coarse.effort;
  this->Bodies.takeAll(this->State.fibres);
}

void Descent::load(CheckpointReader& file)
{
  this->State.load(file);
  file.require(this->isSound());
  this->Bodies.takeAll(this->State.fibres);
}

bool Descent::couldReach(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& radii) const
{
  constexpr double farthest = 10.0 * limits::coordinate.highest; // no run gets this far from a valid start
  const double tolerance = this->Options.radiusTolerance * (1.0 + 1e-9);
  bool good = true;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    // Written so that it is false for NaN.
    good = good && points[i].cwiseAbs().maxCoeff() <= farthest && points[i].allFinite() &&
           std::abs(radii[i] - this->ReferenceRadii[i]) <= tolerance * this->ReferenceRadii[i];
  }
  for (std::size_t k = 0; k < this->Bodies.own().size(); ++k)
  {
    const std::size_t i = this->Bodies.pointOf(k);
    good = good && (points[i + 1] - points[i]).squaredNorm() > 0.0;
  }
  return good;
}

/// Tells whether the loaded state is possible: no number is infinite or NaN.
bool Descent::isSound() const
{
  const DescentState& state = this->State;
  const DescentEffort& effort = state.effort;
  const auto isFinite = [](double value) { return std::isfinite(value); };
  const auto all = [](const auto& values, const auto& good) { return std::all_of(values.begin(), values.end(), good); };
  const bool adagrad = this->Options.method == DescentMethod::Adagrad;
  return this->couldReach(state.fibres.points, state.fibres.radii) &&
         all(state.velocity, [&](const auto& v) { return v.allFinite() && (!adagrad || v.minCoeff() >= 0.0); }) &&
         all(state.radiusVelocity, [&](double v) { return isFinite(v) && (!adagrad || v >= 0.0); }) && state.relaxation > 0.0 &&
         state.relaxation <= 1.0 && effort.neighbourSearches >= 0 && isFinite(effort.pairEvaluations) &&
         isFinite(effort.evaluationSeconds) && isFinite(effort.searchSeconds);
}

} // namespace cactus
