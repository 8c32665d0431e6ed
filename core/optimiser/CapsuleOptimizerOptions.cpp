// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/CapsuleOptimizerOptions.h"

#include "base/Error.h"
#include "base/Limits.h"

namespace cactus
{

namespace
{

const PropertyList<FibreCostWeights>& weightProperties()
{
  using Weights = FibreCostWeights;
  static const auto list =
    PropertyList<Weights>()
      .add(
        "CurvatureWeight", &Weights::curvature, limits::weight, "Weight of the curvature cost, which keeps fibres from kinking")
      .add("LengthWeight", &Weights::length, limits::weight, "Weight of the length cost, which keeps segments from stretching")
      .add("RadiusWeight", &Weights::radius, limits::weight,
        "Weight of the radius cost, which pulls radii back to their initial values; it has no effect unless RadiusTolerance is "
        "above 0")
      .add("CompactnessWeight", &Weights::compactness, limits::weight,
        "Weight of the compactness cost, which keeps each bundle in its cuboid and each fibre in its direction");
  return list;
}

} // namespace

const PropertyList<CapsuleOptimizerOptions>& CapsuleOptimizerOptions::properties()
{
  using Options = CapsuleOptimizerOptions;
  static const auto list =
    PropertyList<Options>()
      .add("MaximumIterations", &Options::maximumIterations, limits::iterations,
        "Largest number of iterations; a run that reaches it ends with its best state and a warning")
      .add("OverlapTolerance", &Options::overlapTolerance, limits::overlapTolerance,
        "Largest relative penetration D = 1 - d / (rp + rq) that may remain between capsules of different fibres")
      .add("Method", &Options::method, { "Momentum", "Adagrad" },
        "Preconditioned heavy ball, or Adagrad as published (with a StepSize of about 0.02 µm)")
      .add("OverlapWeight", &Options::overlapWeight, limits::overlapWeight, "Weight of the overlap cost, the first in priority")
      .include(&Options::weights, weightProperties())
      .add("StepSize", &Options::stepSize, limits::stepSize,
        "Momentum: factor of the preconditioned step; Adagrad: length of the first step in µm")
      .add("Momentum", &Options::momentum, limits::momentum, "Part of the last step that the next one carries on")
      .use(PropertyUse::Code)
      .add("Smoothing", &Options::smoothing, limits::weight, "Stiffness of the thread that spreads a step along its fibre")
      .use(PropertyUse::Code)
      .add("Relaxation", &Options::relaxation, limits::relaxation,
        "Factor that multiplies the curvature, length and compactness costs in every iteration of Momentum")
      .where("Method", { 0 })
      .add("PackingLimit", &Options::packingLimit, limits::packingLimit,
        "A bundle that fills more than this volume fraction of its cuboid is widened to it before its fibres are bent")
      .add("SafetyMargin", &Options::safetyMargin, limits::safetyMargin, "Factor by which capsules act as if they were thicker")
      .use(PropertyUse::Code)
      .add("RadiusTolerance", &Options::radiusTolerance, limits::radiusTolerance,
        "Largest change of a radius, as a fraction of the radius; 0: all radii stay as they are")
      .add("TimeBudget", &Options::timeBudget, limits::seconds,
        "Time limit; a run that reaches it ends with its best state and a warning; 0: no limit")
      .add("CheckpointFile", &Options::checkpointFile,
        "File for the state of the run, written at intervals and at the end; none: not written")
      .use(PropertyUse::Run)
      .add("CheckpointInterval", &Options::checkpointInterval, limits::seconds, "Shortest time between two checkpoints")
      .use(PropertyUse::Run)
      .add("Resume", &Options::resume, "Continue from CheckpointFile if it exists, with the same result as an uninterrupted run")
      .use(PropertyUse::Run);
  return list;
}

void validate(const CapsuleOptimizerOptions& options)
{
  validateProperties(options);
  if (options.resume && options.checkpointFile.empty())
  {
    throw InvalidInput("Resume is on, but there is no CheckpointFile: name the one to go on from");
  }
}

} // namespace cactus
