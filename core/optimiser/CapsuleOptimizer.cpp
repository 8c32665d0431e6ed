// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/CapsuleOptimizer.h"

#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Memory.h"
#include "base/Sharing.h"
#include "fibres/FibreOrder.h"
#include "optimiser/BundleBox.h"
#include "optimiser/FibreShares.h"
#include "optimiser/OptimisationCheckpoints.h"
#include "optimiser/OptimisationRun.h"
#include "optimiser/OverlapReport.h"

#include <algorithm>
#include <chrono>
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

/// Called with each state that a run measures.
using Observe = std::function<void(const ConvergenceRow&)>;

/// Runs the descent to its end, and leaves in `result` why it ended and what it did.
void descend(OptimisationRun& run, const CapsuleOptimizerOptions& options, const Context& context, Clock::time_point start,
  OptimisationCheckpoints& checkpoints, const Observe& observe, OptimisationResult& result)
{
  double completed = 0.0;
  for (;; ++run.iteration)
  {
    if (checkpoints.due())
    {
      checkpoints.write(run);
    }
    Moment moment;
    ConvergenceRow row = run.descent.evaluate([&] { return Moment{ secondsSince(start), context.stopRequested() }; }, moment);
    row.iteration = run.iteration;
    row.seconds = run.seconds + moment.seconds;
    run.note(row, options.overlapTolerance);
    if (observe)
    {
      observe(row);
    }
    if (run.iteration % 10 == 0)
    {
      const double first = run.rows.empty() ? row.maximumPenetration : run.rows.front().maximumPenetration;
      completed = std::max(completed, completedFraction(row, first, options));
      context.report(completed, describe(row));
    }
    const auto reason = reasonToStop(row, run.progress, options, moment);
    if (reason)
    {
      // Before this row is added: a run that goes on from here measures this state again.
      run.seconds = row.seconds;
      checkpoints.write(run);
      run.rows.push_back(row);
      result.reason = *reason;
      break;
    }
    run.rows.push_back(row);
    run.descent.step();
  }
  const DescentEffort& effort = run.descent.state().effort;
  result.pairEvaluations = effort.pairEvaluations;
  result.neighbourSearches = effort.neighbourSearches;
  result.evaluationSeconds = effort.evaluationSeconds;
  result.searchSeconds = effort.searchSeconds;
  result.checkpointFailure = checkpoints.failure();
  result.convergence = std::move(run.rows);
}

/// Puts values of all control points, of which each process has its own, where they belong in the fibres that came in.
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

/// Whether any process has something.
bool hasAny(bool own, const Sharing& sharing)
{
  for (const std::string& told : sharing.exchange(own ? "1" : "0"))
  {
    own = own || told == "1";
  }
  return own;
}

OptimisationResult optimiseTogether(Fibres& fibres, const CapsuleOptimizerOptions& options, const Context& context,
  const std::function<void(const ConvergenceRow&, const Fibres&)>& observe, const Sharing& sharing)
{
  validate(options);
  validate(fibres);
  requireSegmentsToSearch(fibres);
  requireRoom(fibres, sharing.size());
  const Clock::time_point start = Clock::now();
  const int threads = context.threadCount();
  OptimisationCheckpoints checkpoints(fibres, options, sharing);
  OptimisationResult result;
  const FibreOrder order(fibres);
  Fibres all = order.ordered(fibres);
  const FibreShares shares(all, sharing);
  // A state without overlap is left alone.
  const bool apart = measureOverlap(shares.own(all), shares, options.overlapTolerance, threads).overlappingPairs == 0;
  if (!apart && options.weights.compactness > 0.0)
  {
    spreadBundles(all, options.packingLimit);
  }
  std::vector<BundleBox> boxes = shares.ownOf(bundleBoxes(all, options.packingLimit));
  Fibres state = shares.own(std::move(all));
  const auto handBack = [&]
  {
    bringTogether(state.points, shares, order, fibres.points);
    bringTogether(state.radii, shares, order, fibres.radii);
  };
  {
    OptimisationRun run(state, shares, std::move(boxes), options, threads);
    if (options.resume && checkpoints.found())
    {
      checkpoints.load(run);
    }
    Observe handOver;
    if (hasAny(static_cast<bool>(observe), sharing))
    {
      handOver = [&](const ConvergenceRow& row)
      {
        handBack();
        if (observe)
        {
          observe(row, fibres);
        }
      };
    }
    descend(run, options, context, start, checkpoints, handOver, result);
    state.points = std::move(run.bestPoints);
    state.radii = std::move(run.bestRadii);
  }
  // The lists above reach only as far as the descent needs: what is handed back is measured afresh.
  const OverlapReport report = measureOverlap(state, shares, options.overlapTolerance, threads);
  result.maximumPenetration = std::max(0.0, report.largestPenetration);
  result.overlappingPairs = report.overlappingPairs;
  bringTogether(report.perPoint, shares, order, result.overlap);
  handBack();
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
