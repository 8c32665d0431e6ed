// SPDX-License-Identifier: BSD-3-Clause
// Benchmark of the outer and inner surfaces of a bundle made by the chain, spacing and all checks included; on one thread, rates
// by processor time.
#include "bundle/BundleInitializer.h"
#include "fibres/TrimToDomain.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"
#include "optimiser/CapsuleOptimizer.h"
#include "surface/MyelinSurface.h"

#include <benchmark/benchmark.h>

#include <cstddef>

namespace
{

using namespace cactus;

/// Arguments: dispersion in degrees, Watson's model or the default one.
void makeMyelinSurfaces(benchmark::State& state)
{
  BundleInitializerOptions wanted;
  wanted.border = Border::Walls;
  wanted.correlationLength = 0.0;
  wanted.side = 10.0;
  wanted.meanDispersion = static_cast<double>(state.range(0));
  wanted.dispersionModel = state.range(1) != 0 ? DispersionModel::Watson : DispersionModel::Coherent;
  Context context;
  context.threads = 1;
  Fibres fibres = initialiseBundles(wanted, context);
  optimise(fibres, CapsuleOptimizerOptions{}, context);
  fibres = trimToDomain(fibres);
  const FibreRadialGrowthOptions growth;
  const Fibres aimed = aimAtTargetRadii(fibres, growth, context);
  const LabelImage image =
    growFibres(aimed, growth, growthFor(aimed, growth, context).growth, growthGrid(fibres.domain, growth), context);
  const LabelImageFacts facts = labelImageFacts(fibres, growth);
  const LabelImageView view{ image.grid, image.fibreId.data(), image.depth.data(), growth.gap() };
  std::size_t triangles = 0;
  for (auto _ : state)
  {
    triangles = 0;
    for (const FibreSurfacePair& pair : myelinSurfaces(view, facts, MyelinSurfaceOptions(), context))
    {
      triangles += pair.outer.triangles.size() + pair.inner.triangles.size();
    }
  }
  double length = 0.0; // µm, of all fibres
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f] + 1; i < fibres.offsets[f + 1]; ++i)
    {
      length += (fibres.points[i] - fibres.points[i - 1]).norm();
    }
  }
  using benchmark::Counter;
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["s/um"] = Counter(length, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

BENCHMARK(makeMyelinSurfaces)
  ->ArgNames({ "dispersion", "Watson" })
  ->Args({ 10, 0 })
  ->Args({ 10, 1 })
  ->Unit(benchmark::kMillisecond);

} // namespace
