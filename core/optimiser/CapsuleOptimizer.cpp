// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/CapsuleOptimizer.h"

#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Memory.h"
#include "base/Sharing.h"
#include "fibres/FibreOrder.h"
#include "optimiser/BundleBox.h"
#include "optimiser/CoarseFibres.h"
#include "optimiser/FibreShares.h"
#include "optimiser/OptimisationCheckpoints.h"
#include "optimiser/OptimisationRun.h"
#include "optimiser/OverlapReport.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace cactus
{

namespace
{

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Length (µm) of all centre lines together.
double totalLength(const Fibres& fibres)
{
  double length = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      length += (fibres.points[i + 1] - fibres.points[i]).norm();
    }
  }
  return length;
}

/// What a descent takes for a control point, with some fifty neighbours: of the fibres that a process moves, and of all fibres.
constexpr double bytesPerOwnPoint = 900.0;
constexpr double bytesPerPoint = 100.0;

std::string describe(const ConvergenceRow& row)
{
  TextStream text;
  text.precision(3);
  text << "iteration " << row.iteration << ": largest penetration " << row.maximumPenetration << ", " << row.overlappingPairs
       << " pairs overlap";
  return text.str();
}

/// Throws InvalidInput for a fibre whose capsules are so much shorter than thick that the neighbour search, which skips capsules
/// of the same fibre, would not end.
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

/// Throws InvalidInput for several bundles that together fill more than the domain holds.
void requireShares(const Fibres& fibres)
{
  const auto isOther = [&](int bundle) { return bundle != fibres.bundleIds.front(); };
  if (std::none_of(fibres.bundleIds.begin(), fibres.bundleIds.end(), isOther))
  {
    return;
  }
  const double filled = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
  if (filled > 1.0)
  {
    throw InvalidInput(text("the fibres of all bundles together have ", std::round(100.0 * filled) / 100.0,
      " times the domain's volume: give each bundle a smaller share (FibreVolumeFraction of its source), about 0.7 in all"));
  }
}

/// The common context of the runs of an optimisation.
struct Surroundings
{
  const CapsuleOptimizerOptions& options;
  const Context& context;
  Clock::time_point start;
  OptimisationCheckpoints& checkpoints;
  const Sharing* all; ///< the processes that each do all the work; null where they share it
  /// Called with each state that a run measures: control points and radii of the input fibres. Empty if there is no observer.
  std::function<void(const ConvergenceRow&, const std::vector<Eigen::Vector3d>&, const std::vector<double>&)> observe;
  double completed = 0.0; ///< last reported progress
};

/// Returns this process's moment or, where each does all the work, that of all: the first one's time, and whether any is to stop.
Moment momentOf(const Surroundings& around)
{
  Moment moment{ secondsSince(around.start), around.context.stopRequested() };
  if (around.all == nullptr)
  {
    return moment;
  }
  const std::vector<std::string> told = around.all->exchange(bytesOf(moment));
  for (std::size_t process = 0; process < told.size(); ++process)
  {
    Moment theirs;
    getAll(told[process], theirs);
    moment = process == 0 ? theirs : Moment{ moment.seconds, moment.wantsStop || theirs.wantsStop };
  }
  return moment;
}

/// Tells whether a run with fewer control points continues with all of them.
bool isToBeRefined(const OptimisationRun& run, const std::optional<StopReason>& reason)
{
  const bool ended = reason && *reason != StopReason::Converged && *reason != StopReason::Stagnated;
  return run.level == OptimisationRun::Coarse && !ended && (reason || run.descent.isLaidOut());
}

/// Runs the descent to its end, and returns why it ended; nothing if it continues with more control points.
std::optional<StopReason> descend(
  OptimisationRun& run, Surroundings& around, const std::function<void(const ConvergenceRow&)>& show)
{
  for (;; ++run.iteration)
  {
    if (around.checkpoints.due())
    {
      around.checkpoints.write(run);
    }
    Moment moment;
    ConvergenceRow row = run.descent.evaluate([&] { return momentOf(around); }, moment);
    row.iteration = run.iteration;
    row.seconds = run.seconds + moment.seconds;
    run.note(row, around.options.overlapTolerance);
    if (around.observe)
    {
      show(row);
    }
    if (run.iteration % 10 == 0)
    {
      const double first = run.rows.empty() ? row.maximumPenetration : run.rows.front().maximumPenetration;
      around.completed = std::max(around.completed, completedFraction(row, first, around.options));
      const std::string& failure = around.checkpoints.failure();
      around.context.report(around.completed, describe(row) + (failure.empty() ? "" : "; cannot be written down: " + failure));
    }
    const auto reason = reasonToStop(row, run.progress, around.options, moment);
    if (isToBeRefined(run, reason))
    {
      run.rows.push_back(row);
      ++run.iteration;
      return std::nullopt;
    }
    if (reason)
    {
      // Before this row is added: a resumed run measures this state again.
      run.seconds = row.seconds;
      around.checkpoints.write(run);
      run.rows.push_back(row);
      return reason;
    }
    run.rows.push_back(row);
    run.descent.step();
  }
}

/// Fills in the result of a run.
void tell(OptimisationRun& run, StopReason reason, OptimisationResult& result)
{
  result.reason = reason;
  const DescentEffort& effort = run.descent.state().effort;
  result.pairEvaluations = effort.pairEvaluations;
  result.neighbourSearches = effort.neighbourSearches;
  result.evaluationSeconds = effort.evaluationSeconds;
  result.searchSeconds = effort.searchSeconds;
  result.convergence = std::move(run.rows);
}

/// Returns the shares of the fibres with fewer control points; nothing if these would not help: most control points have to stay,
/// radii (of single control points) change, fibres repeat after a number of control points, or the method is the published one.
std::optional<FibreShares> sharesOfFewer(const Fibres& fibres, const FibreShares& shares, const CapsuleOptimizerOptions& options)
{
  constexpr double most = 0.75; // of the control points
  if (options.method != DescentMethod::Momentum || options.radiusTolerance > 0.0 || fibres.domain.periodic[2])
  {
    return std::nullopt;
  }
  const CoarseFibres fewer(fibres);
  if (static_cast<double>(fewer.fibres().points.size()) > most * static_cast<double>(fibres.points.size()))
  {
    return std::nullopt;
  }
  return FibreShares(fewer.fibres(), shares);
}

/// Returns the options with which fibres of half as many control points take nearly the same shape: the costs of a bend or a
/// stretch of the same size grow with a power of the distance between control points, while that of an overlap does not.
CapsuleOptimizerOptions optionsForFewer(CapsuleOptimizerOptions options)
{
  options.weights.curvature /= 8.0;
  options.weights.length /= 2.0;
  return options;
}

/// Moves the fibres with fewer control points first, if they have shares, and then with all. Leaves the best state in `state`,
/// and the run's report in `result`.
void descendThroughLevels(Fibres& state, const FibreShares& shares, const std::optional<FibreShares>& coarseShares,
  const std::vector<BundleBox>& boxes, Surroundings& around, OptimisationResult& result)
{
  const int threads = around.context.threadCount();
  const bool resumes = around.options.resume && around.checkpoints.found();
  const CapsuleOptimizerOptions coarseOptions = optionsForFewer(around.options);
  const CoarseFibres fewer(coarseShares ? state : Fibres());
  Fibres moved = fewer.fibres();
  std::optional<OptimisationRun> coarse;
  if (coarseShares && !(resumes && around.checkpoints.level() == OptimisationRun::Fine))
  {
    coarse.emplace(OptimisationRun::Coarse, moved, *coarseShares, boxes, coarseOptions, threads);
    if (resumes)
    {
      around.checkpoints.load(*coarse);
    }
    const auto reason = descend(*coarse, around,
      [&](const ConvergenceRow& row) { around.observe(row, fewer.refine(moved.points, state.points), state.radii); });
    if (reason)
    {
      state.points = fewer.refine(coarse->bestPoints, state.points);
      tell(*coarse, *reason, result);
      return;
    }
  }
  OptimisationRun run(OptimisationRun::Fine, state, shares, boxes, around.options, threads);
  if (coarse)
  {
    run.takeOver(*coarse, fewer);
    coarse.reset();
  }
  else if (resumes)
  {
    around.checkpoints.load(run);
  }
  const auto reason = descend(run, around, [&](const ConvergenceRow& row) { around.observe(row, state.points, state.radii); });
  state.points = std::move(run.bestPoints);
  state.radii = std::move(run.bestRadii);
  tell(run, *reason, result);
}

/// Gathers values of all control points, of which each process has its own, in the order of the input fibres.
template <typename Value>
void bringTogether(
  const std::vector<Value>& own, const FibreShares& shares, const FibreOrder& order, std::vector<Value>& original)
{
  if (shares.processes() == 1)
  {
    order.restore(own, original);
    return;
  }
  ByteWriter mine;
  mine.addAll(own.data(), own.size());
  const std::vector<std::string> all = shares.sharing().exchange(mine.bytes());
  mine = {};
  original.resize(shares.pointCount());
  std::vector<Value> part;
  for (std::size_t process = 0; process < all.size(); ++process)
  {
    part.resize(shares.pointBegin(process + 1) - shares.pointBegin(process));
    ByteReader(all[process]).getAll(part.data(), part.size());
    order.restore(part.data(), part.size(), shares.pointBegin(process), original);
  }
}

void requireRoom(const Fibres& fibres, int processes)
{
  const auto points = static_cast<double>(fibres.points.size());
  requireMemory((bytesPerPoint + bytesPerOwnPoint / processes) * points,
    text("an optimisation of ", fibres.size(), " fibres with ", fibres.points.size(), " control points",
      processes > 1 ? text(" on ", processes, " ranks") : std::string()),
    "use fewer fibres, or a larger spacing of their control points");
}

OptimisationResult optimiseTogether(Fibres& fibres, const CapsuleOptimizerOptions& options, const Context& context,
  const std::function<void(const ConvergenceRow&, const Fibres&)>& observe, const Sharing& team)
{
  validate(options);
  validate(fibres);
  requireShares(fibres);
  if (fibres.domain.isPeriodic() && team.size() > 1 && !options.checkpointFile.empty())
  {
    throw InvalidInput("CheckpointFile cannot be kept for a periodic domain on several ranks: leave it empty, or use one rank");
  }
  // Images of capsules are found among those of one process: in a periodic domain each does all the work.
  const Sharing alone;
  const Sharing& sharing = fibres.domain.isPeriodic() ? alone : team;
  OptimisationResult result;
  const double givenLength = totalLength(fibres);
  if (!fibres.domain.periodic[2]) // such fibres come from BundleInitializer
  {
    result.resampling = resampleDenseFibres(fibres);
  }
  requireSegmentsToSearch(fibres);
  requireRoom(fibres, sharing.size());
  const Clock::time_point start = Clock::now();
  const int threads = context.threadCount();
  OptimisationCheckpoints checkpoints(fibres, options, sharing);
  const FibreOrder order(fibres);
  Fibres all = order.ordered(fibres);
  const FibreShares shares(all, sharing);
  // A state without overlap stays as it is.
  const bool apart = measureOverlap(shares.own(all), shares, options.overlapTolerance, threads).overlappingPairs == 0;
  if (!apart && options.weights.compactness > 0.0)
  {
    spreadBundles(all, options.packingLimit);
  }
  const std::optional<FibreShares> coarseShares = apart ? std::nullopt : sharesOfFewer(all, shares, options);
  const std::vector<BundleBox> boxes = shares.ownOf(bundleBoxes(all, options.packingLimit));
  Fibres state = shares.own(std::move(all));
  const auto handBack = [&](const std::vector<Eigen::Vector3d>& points, const std::vector<double>& radii)
  {
    bringTogether(points, shares, order, fibres.points);
    bringTogether(radii, shares, order, fibres.radii);
  };
  Surroundings around{ options, context, start, checkpoints, &sharing == &alone ? &team : nullptr, {} };
  if (!sharing.isEverywhere(!observe))
  {
    around.observe = [&](const ConvergenceRow& row, const std::vector<Eigen::Vector3d>& points, const std::vector<double>& radii)
    {
      handBack(points, radii);
      if (observe)
      {
        observe(row, fibres);
      }
    };
  }
  descendThroughLevels(state, shares, coarseShares, boxes, around, result);
  result.checkpointFailure = checkpoints.failure();
  // The lists above reach only as far as the descent needs: the returned fibres are measured afresh.
  const OverlapReport report = measureOverlap(state, shares, options.overlapTolerance, threads);
  result.maximumPenetration = std::max(0.0, report.largestPenetration);
  result.overlappingPairs = report.overlappingPairs;
  bringTogether(report.perPoint, shares, order, result.overlap);
  handBack(state.points, state.radii);
  result.lengthIncrease = totalLength(fibres) / givenLength - 1.0;
  return result;
}

} // namespace

OptimisationResult optimise(Fibres& fibres, const CapsuleOptimizerOptions& options, const Context& context,
  const std::function<void(const ConvergenceRow&, const Fibres&)>& observe, Team* team)
{
  const Sharing sharing(team);
  OptimisationResult result;
  sharing.together([&] { result = optimiseTogether(fibres, options, context, observe, sharing); });
  return result;
}

} // namespace cactus
