// SPDX-License-Identifier: BSD-3-Clause
// Benchmarks of the joint optimisation, in parts and as a whole; one thread unless the name says otherwise. Rates are per second
// of wall time.
#include "BenchmarkBundle.h"
#include "optimiser/CapsuleOptimizer.h"
#include "optimiser/NeighbourSearch.h"
#include "optimiser/OverlapCost.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace
{

using namespace cactus;

/// 10⁴ to 10⁶ capsules, and 10⁷ (which takes some 9 GB) if the environment variable CACTUS_BENCHMARK_LARGE is set.
void sizes(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgName("capsules");
  for (const std::int64_t size : { 10000, 100000, 1000000 })
  {
    benchmark->Arg(size);
  }
  if (std::getenv("CACTUS_BENCHMARK_LARGE") != nullptr)
  {
    benchmark->Arg(10000000);
  }
}

/// The cost and gradient of all pairs, each evaluated from both sides.
void overlapCost(benchmark::State& state)
{
  const Capsules capsules = capsulesOf(benchmarkBundle(static_cast<std::size_t>(state.range(0))));
  NeighbourList neighbours;
  findNeighbours(capsules, 0.1, 1, neighbours);
  std::vector<CapsuleOverlap> overlaps;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(evaluateOverlap(capsules, neighbours, 1.005, 1e-3, 1, overlaps));
  }
  state.counters["pairs"] =
    benchmark::Counter(static_cast<double>(neighbours.indices.size()), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["neighbours"] = static_cast<double>(neighbours.indices.size()) / static_cast<double>(capsules.size());
}
BENCHMARK(overlapCost)->Name("OverlapCost")->Apply(sizes)->Unit(benchmark::kMillisecond);

void neighbourSearch(benchmark::State& state)
{
  const Capsules capsules = capsulesOf(benchmarkBundle(static_cast<std::size_t>(state.range(0))));
  NeighbourList neighbours;
  for (auto _ : state)
  {
    findNeighbours(capsules, 0.1, 1, neighbours);
  }
  state.counters["pairs"] =
    benchmark::Counter(static_cast<double>(neighbours.indices.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(neighbourSearch)->Name("NeighbourSearch")->Apply(sizes)->Unit(benchmark::kMillisecond);

/// Twenty iterations of the descent, set-up and final measurement included.
void optimiseBundle(benchmark::State& state)
{
  const Fibres initial = benchmarkBundle(static_cast<std::size_t>(state.range(0)));
  CapsuleOptimizerOptions options;
  options.maximumIterations = 20;
  Context context;
  context.threads = 1;
  OptimisationResult result;
  for (auto _ : state)
  {
    Fibres fibres = initial;
    result = optimise(fibres, options, context);
  }
  const auto capsules = static_cast<double>(initial.points.size() - initial.size());
  const int iterations = result.convergence.back().iteration;
  state.counters["capsule_iterations"] =
    benchmark::Counter(capsules * std::max(1, iterations), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["pairs_in_evaluation"] = result.pairEvaluations / result.evaluationSeconds;
  state.counters["search_share"] = result.searchSeconds / result.convergence.back().seconds;
  state.counters["searches"] = result.neighbourSearches;
}
BENCHMARK(optimiseBundle)->Name("CapsuleOptimizer")->Apply(sizes)->Unit(benchmark::kMillisecond)->Iterations(1);

} // namespace
