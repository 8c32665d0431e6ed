// SPDX-License-Identifier: BSD-3-Clause
// Growth of a bundle of bent fibres of two calibres, packed to two thirds before it grows; rates are per voxel and second of wall
// time.
#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

namespace
{

using namespace cactus;

Fibres bundle(double side)
{
  Fibres fibres;
  fibres.domain = Domain::cube(side);
  const double pitch = 1.5;
  const int rows = static_cast<int>(side / pitch) + 1;
  for (int row = -rows; row <= rows; ++row)
  {
    for (int column = -rows; column <= rows; ++column)
    {
      const double x = pitch * (column + 0.5 * std::abs(row % 2));
      const double y = pitch * std::sqrt(0.75) * row;
      if (std::max(std::abs(x), std::abs(y)) > 0.5 * side + 1.0)
      {
        continue;
      }
      const double radius = (row + column) % 3 == 0 ? 0.5 : 0.75;
      fibres.addFibre(static_cast<int>(fibres.size()) + 1, 1, radius);
      for (double z = -0.5 * side; z < 0.5 * side + 0.5; z += 0.75)
      {
        fibres.addPoint({ x + 0.3 * std::sin(0.4 * z), y + 0.3 * std::cos(0.3 * z), z }, radius * (1.0 + 0.1 * std::sin(z)));
      }
    }
  }
  return fibres;
}

/// Arguments: voxel in nm, roughness in per cent.
void growFibreRadially(benchmark::State& state)
{
  const Fibres fibres = bundle(12.0);
  FibreRadialGrowthOptions options;
  options.voxelSize = 1e-3 * static_cast<double>(state.range(0));
  options.surfaceRoughness = 1e-2 * static_cast<double>(state.range(1));
  Context context;
  context.threads = 1;
  const VoxelGrid grid = growthGrid(fibres.domain, options);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(growFibres(fibres, options, 0.2, grid, context));
  }
  state.counters["voxels"] = benchmark::Counter(static_cast<double>(grid.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(growFibreRadially)
  ->Name("FibreRadialGrowth")
  ->ArgNames({ "voxel_nm", "roughness_percent" })
  ->Args({ 100, 0 })
  ->Args({ 100, 20 })
  ->Args({ 50, 0 })
  ->Args({ 50, 20 })
  ->Unit(benchmark::kMillisecond);

/// Times work(fibres, options, context) towards filling nine tenths of the domain.
template <typename Work>
void aimAtNineTenths(benchmark::State& state, Work&& work)
{
  const Fibres fibres = bundle(12.0);
  FibreRadialGrowthOptions options;
  options.targetFibreVolumeFraction = 0.9;
  Context context;
  context.threads = 1;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(work(fibres, options, context, Sharing()));
  }
}

/// The search for the growth that fills the domain.
BENCHMARK_CAPTURE(aimAtNineTenths, growth, growthFor)->Name("FibreRadialGrowthTarget")->Unit(benchmark::kMillisecond);
/// The radii from which growth ends at the target radii.
BENCHMARK_CAPTURE(aimAtNineTenths, radii, aimAtTargetRadii)->Name("FibreRadialGrowthTargetRadii")->Unit(benchmark::kMillisecond);

} // namespace
