// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/CapsuleOptimizer.h"

#include "base/Error.h"
#include "base/Memory.h"
#include "fibres/FibreOrder.h"
#include "optimiser/BundleBox.h"
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

/// What a descent takes for a control point, with some fifty neighbours.
constexpr double bytesPerPoint = 1000.0;

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
    if (checkpoints.due(run))
    {
      checkpoints.write(run);
    }
    ConvergenceRow row = run.descent.evaluate();
    row.iteration = run.iteration;
    row.seconds = run.seconds + secondsSince(start);
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
    const auto reason = reasonToStop(row, run.progress, options, context, secondsSince(start));
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

} // namespace

OptimisationResult optimise(Fibres& fibres, const CapsuleOptimizerOptions& options, const Context& context,
  const std::function<void(const ConvergenceRow&, const Fibres&)>& observe)
{
  validate(options);
  validate(fibres);
  requireSegmentsToSearch(fibres);
  requireMemory(bytesPerPoint * static_cast<double>(fibres.points.size()),
    text("an optimisation of ", fibres.size(), " fibres with ", fibres.points.size(), " control points"),
    "use fewer fibres, or a larger spacing of their control points");
  const Clock::time_point start = Clock::now();
  const int threads = context.threadCount();
  OptimisationCheckpoints checkpoints(fibres, options);
  OptimisationResult result;
  const FibreOrder order(fibres);
  Fibres state = order.ordered(fibres);
  const auto handBack = [&]
  {
    order.restore(state.points, fibres.points);
    order.restore(state.radii, fibres.radii);
  };
  // A state without overlap is left alone.
  const bool apart = measureOverlap(state, options.overlapTolerance, threads).overlappingPairs == 0;
  if (!apart && options.weights.compactness > 0.0)
  {
    spreadBundles(state, options.packingLimit);
  }
  {
    OptimisationRun run(state, options, threads);
    if (options.resume && checkpoints.found())
    {
      checkpoints.load(run);
    }
    Observe handOver;
    if (observe)
    {
      handOver = [&](const ConvergenceRow& row)
      {
        handBack();
        observe(row, fibres);
      };
    }
    descend(run, options, context, start, checkpoints, handOver, result);
    state.points = std::move(run.bestPoints);
    state.radii = std::move(run.bestRadii);
  }
  // The lists above reach only as far as the descent needs: what is handed back is measured afresh.
  const OverlapReport report = measureOverlap(state, options.overlapTolerance, threads);
  result.maximumPenetration = std::max(0.0, report.largestPenetration);
  result.overlappingPairs = report.overlappingPairs;
  order.restore(report.perPoint, result.overlap);
  handBack();
  return result;
}

} // namespace cactus
