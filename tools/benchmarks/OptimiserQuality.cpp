// SPDX-License-Identifier: BSD-3-Clause
// Runs the optimiser on initial states of all kinds: one row of a Markdown table per state.
//
//   cactus_optimiser_quality [--threads N] [--iterations N] [--seconds N] [--seed N] [--method momentum|adagrad]
//     [--convergence FILE.csv] [--progress on] [--OPTION VALUE]... STATE...
//
// where STATE is a name below, a pattern of them ("single-*"), or the path of a strand file, and OPTION is a parameter of the
// optimiser in lower case (relaxation, momentum, smoothing, step, curvature, length, compactness, packing, margin, radius).
#include "bundle/BundleInitializer.h"
#include "fibres/FibreShape.h"
#include "io/StrandFile.h"
#include "optimiser/CapsuleOptimizer.h"
#include "optimiser/OverlapReport.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fnmatch.h>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace
{

using namespace cactus;

struct State
{
  std::string name;
  std::function<Fibres(std::uint64_t seed, const Context&)> make;
};

BundleInitializerOptions bundle(double side, double density, double dispersion, std::uint64_t seed)
{
  BundleInitializerOptions options;
  options.border = Border::Walls;
  options.correlationLength = 0.0;
  options.side = side;
  options.fibreVolumeFraction = density;
  options.meanDispersion = dispersion;
  options.seed = seed;
  return options;
}

/// Makes neighbouring fibres alike, with capsules that fill 0.7 of the domain: slanted fibres are longer than the distance of the
/// faces.
Fibres coherentBundle(double dispersion, std::uint64_t seed, const Context& context)
{
  double density = 0.7;
  for (int round = 0;; ++round)
  {
    const Fibres fibres = initialiseBundles(bundle(30.0, density, dispersion, seed), context);
    const double filled = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
    if (round == 3 || std::abs(filled - 0.7) < 0.002)
    {
      return fibres;
    }
    density *= 0.7 / filled;
  }
}

/// Draws each fibre's direction independently, as the paper and the reference program do.
BundleInitializerOptions independent(BundleInitializerOptions options)
{
  options.dispersionModel = DispersionModel::Watson;
  return options;
}

/// Makes three bundles along x, y and z, together as dense as one of `density`.
Fibres threeBundles(double side, double density, std::uint64_t seed, const Context& context)
{
  Fibres all;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Fibres one = initialiseBundles(bundle(side, density / 3.0, 5.0, 10 * seed + static_cast<std::uint64_t>(axis)), context);
    all.domain = one.domain;
    for (std::size_t f = 0; f < one.size(); ++f)
    {
      all.addFibre(static_cast<int>(all.size()) + 1, axis + 1, one.targetRadii[f]);
      for (std::size_t i = one.offsets[f]; i < one.offsets[f + 1]; ++i)
      {
        const Eigen::Vector3d& p = one.points[i];
        all.addPoint(Eigen::Vector3d(p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]), one.radii[i]);
      }
    }
  }
  return all;
}

std::vector<State> states()
{
  std::vector<State> all;
  for (const int dispersion : { 0, 5, 10, 15, 20, 25 })
  {
    all.push_back({ "single-" + std::to_string(dispersion),
      [dispersion](std::uint64_t seed, const Context& context) { return coherentBundle(dispersion, seed, context); } });
    all.push_back({ "independent-" + std::to_string(dispersion), [dispersion](std::uint64_t seed, const Context& context)
      { return initialiseBundles(independent(bundle(30.0, 0.7, dispersion, seed)), context); } });
  }
  for (const bool sheets : { false, true })
  {
    for (const int angle : { 30, 45, 60, 75, 90 })
    {
      all.push_back({ std::string(sheets ? "sheets-" : "interwoven-") + std::to_string(angle),
        [angle, sheets](std::uint64_t seed, const Context& context)
        {
          BundleInitializerOptions options = bundle(30.0, 0.7, 5.0, seed);
          options.numberOfBundles = 2;
          options.crossingAngle = angle;
          options.crossingStyle = sheets ? CrossingStyle::Sheets : CrossingStyle::Interwoven;
          return initialiseBundles(options, context);
        } });
    }
  }
  for (const int percent : { 30, 45, 60 })
  {
    all.push_back({ "three-" + std::to_string(percent),
      [percent](std::uint64_t seed, const Context& context) { return threeBundles(30.0, 0.01 * percent, seed, context); } });
  }
  for (const int side : { 30, 50, 100 })
  {
    all.push_back({ "reference-" + std::to_string(side), [side](std::uint64_t seed, const Context& context)
      {
        BundleInitializerOptions options = independent(bundle(side, 0.75, 10.0, seed));
        options.radius.minimum = 0.27;
        options.radius.maximum = 2.2;
        return initialiseBundles(options, context);
      } });
  }
  all.push_back({ "reference-crossing", [](std::uint64_t seed, const Context& context)
    {
      BundleInitializerOptions options = bundle(30.0, 0.5, 10.0, seed);
      options.radius.gammaShape = 3.0;
      options.radius.gammaScale = 0.2;
      options.radius.minimum = 0.27;
      options.radius.maximum = 2.2;
      options.numberOfBundles = 2;
      options.crossingAngle = 60.0;
      return initialiseBundles(options, context);
    } });
  all.push_back({ "paper-500", [](std::uint64_t seed, const Context& context)
    {
      BundleInitializerOptions options = independent(bundle(500.0, 0.7, 5.0, seed));
      options.radius.gammaShape = 6.0;
      return initialiseBundles(options, context);
    } });
  return all;
}

/// The file for the convergence of all states, one after the other; empty for none.
std::string convergencePath;

void writeConvergence(const std::string& name, const std::vector<ConvergenceRow>& rows)
{
  static bool isBegun = false;
  std::ofstream file(convergencePath, isBegun ? std::ios::app : std::ios::trunc);
  if (!isBegun)
  {
    file << "State,Iteration,OverlapCost,MaximumPenetration,OverlappingPairs,CurvatureCost,LengthCost,CompactnessCost,Seconds\n";
    isBegun = true;
  }
  for (const ConvergenceRow& row : rows)
  {
    file << name << ',' << row.iteration << ',' << row.overlapCost << ',' << row.maximumPenetration << ',' << row.overlappingPairs
         << ',' << row.curvatureCost << ',' << row.lengthCost << ',' << row.compactnessCost << ',' << row.seconds << '\n';
  }
}

void measure(const std::string& name, Fibres fibres, const CapsuleOptimizerOptions& options, const Context& context)
{
  const Fibres before = fibres;
  const OverlapReport overlap = measureOverlap(before, options.overlapTolerance, context.threads);
  const std::clock_t start = std::clock();
  const OptimisationResult result = optimise(fibres, options, context);
  const double processorSeconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const ConvergenceRow& last = result.convergence.back();
  if (!convergencePath.empty())
  {
    writeConvergence(name, result.convergence);
  }
  const FibreShape old = measureShape(before);
  const FibreShape now = measureShape(fibres);
  char crossing[32] = "–";
  if (old.crossingAngle > 0.0)
  {
    std::snprintf(crossing, sizeof(crossing), "%.1f → %.1f", old.crossingAngle, now.crossingAngle);
  }
  std::printf(
    "| %s | %zu | %zu | %zu → %zu | %.1e | %d | %.1f, %.1f | %.3f → %.3f | %.1f → %.1f | %.1f → %.1f | %s | %.2f | %.1f %% | "
    "%.0f %% (%d) | %.1f |\n",
    name.c_str(), fibres.size(), fibres.points.size(), overlap.overlappingPairs, result.overlappingPairs,
    result.maximumPenetration, last.iteration, last.seconds, processorSeconds,
    capsuleVolumeInDomain(before) / before.domain.volume(), capsuleVolumeInDomain(fibres) / fibres.domain.volume(),
    old.meanDispersion, now.meanDispersion, old.tangentDispersion, now.tangentDispersion, crossing, now.smallestBendRadius,
    100.0 * (now.totalLength / old.totalLength - 1.0), 100.0 * result.searchSeconds / last.seconds, result.neighbourSearches,
    1e-6 * result.pairEvaluations / result.evaluationSeconds);
  std::fflush(stdout);
}

int run(int count, char** arguments)
{
  CapsuleOptimizerOptions options;
  Context context;
  context.threads = 1;
  std::uint64_t seed = 1;
  const std::map<std::string, double*> reals = { { "--seconds", &options.timeBudget }, { "--relaxation", &options.relaxation },
    { "--momentum", &options.momentum }, { "--smoothing", &options.smoothing }, { "--step", &options.stepSize },
    { "--curvature", &options.weights.curvature }, { "--length", &options.weights.length },
    { "--compactness", &options.weights.compactness }, { "--packing", &options.packingLimit },
    { "--margin", &options.safetyMargin }, { "--radius", &options.radiusTolerance } };
  std::vector<std::string> names;
  for (int i = 1; i < count; ++i)
  {
    const std::string argument = arguments[i];
    const bool isOption = argument.rfind("--", 0) == 0;
    if (isOption && i + 1 == count)
    {
      std::fprintf(stderr, "%s wants a value\n", argument.c_str());
      return 2;
    }
    if (argument == "--threads")
    {
      context.threads = std::atoi(arguments[++i]);
    }
    else if (argument == "--iterations")
    {
      options.maximumIterations = std::atoi(arguments[++i]);
    }
    else if (argument == "--method")
    {
      options.method = std::string(arguments[++i]) == "adagrad" ? DescentMethod::Adagrad : DescentMethod::Momentum;
    }
    else if (argument == "--convergence")
    {
      convergencePath = arguments[++i];
    }
    else if (argument == "--progress" && arguments[i + 1] == std::string("on"))
    {
      ++i;
      context.progress = [](double, const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); };
    }
    else if (argument == "--seed")
    {
      seed = std::strtoull(arguments[++i], nullptr, 10);
    }
    else if (reals.count(argument) > 0)
    {
      *reals.at(argument) = std::atof(arguments[++i]);
    }
    else if (isOption)
    {
      std::fprintf(stderr, "there is no option %s\n", argument.c_str());
      return 2;
    }
    else
    {
      names.push_back(argument);
    }
  }
  const std::vector<State> all = states();
  if (names.empty())
  {
    for (const State& state : all)
    {
      std::printf("%s\n", state.name.c_str());
    }
    return 0;
  }
  std::printf("| state | fibres | control points | overlapping pairs | largest D | iterations | seconds: wall, processor | "
              "capsule fraction | dispersion "
              "(°) | tangents (°) | crossing (°) | bend / radius | length | search (times) | million pairs/s |\n"
              "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  int failed = 0;
  for (const std::string& name : names)
  {
    bool found = false;
    for (const State& state : all)
    {
      if (fnmatch(name.c_str(), state.name.c_str(), 0) != 0)
      {
        continue;
      }
      found = true;
      try
      {
        measure(state.name, state.make(seed, context), options, context);
      }
      catch (const std::exception& error)
      {
        std::printf("| %s | %s |\n", state.name.c_str(), error.what());
        ++failed;
      }
    }
    if (!found)
    {
      measure(name.substr(name.rfind('/') + 1), readStrandFile(name), options, context);
    }
  }
  return failed > 0 ? 1 : 0;
}

} // namespace

int main(int count, char** arguments)
{
  try
  {
    return run(count, arguments);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
