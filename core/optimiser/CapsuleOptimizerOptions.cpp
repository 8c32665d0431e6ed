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
        "CurvatureWeight", &Weights::curvature, limits::weight, "Weight of the curvature cost, which keeps fibres from kinking.")
      .add("LengthWeight", &Weights::length, limits::weight, "Weight of the length cost, which keeps segments from stretching.")
      .add("RadiusWeight", &Weights::radius, limits::weight,
        "Weight of the radius cost, which pulls radii back to their initial values. It has no effect unless RadiusTolerance is "
        "above 0.")
      .add("CompactnessWeight", &Weights::compactness, limits::weight,
        "Weight of the compactness cost. It keeps each bundle laterally inside its own cuboid and each fibre in its end-to-end "
        "direction, and thus density and dispersion.");
  return list;
}

} // namespace

const PropertyList<CapsuleOptimizerOptions>& CapsuleOptimizerOptions::properties()
{
  using Options = CapsuleOptimizerOptions;
  static const auto list =
    PropertyList<Options>()
      .add("MaximumIterations", &Options::maximumIterations, limits::iterations,
        "Largest number of iterations. A run that reaches it ends with its best state and a warning.")
      .add("OverlapTolerance", &Options::overlapTolerance, limits::overlapTolerance,
        "Largest relative penetration D = 1 - d / (rp + rq) that may remain between capsules of different fibres; it has no "
        "unit. d is the distance of their centre lines, rp and rq are their radii there.")
      .add("Method", &Options::method, { "Momentum", "Adagrad" },
        "Momentum: heavy ball with a preconditioner along each fibre, by far the faster one. Adagrad: as published; use a "
        "StepSize of about 0.02 µm with it.")
      .add("OverlapWeight", &Options::overlapWeight, limits::overlapWeight, "Weight of the overlap cost, the first in priority.")
      .include(&Options::weights, weightProperties())
      .add("StepSize", &Options::stepSize, limits::stepSize,
        "Momentum: factor of the preconditioned step, without unit; above 1.9 the descent may not settle. Adagrad: length of the "
        "first step in µm.")
      .add("Momentum", &Options::momentum, limits::momentum, "Part of the last step that the next one carries on.")
      .use(PropertyUse::Code)
      .add("Smoothing", &Options::smoothing, limits::weight, "Stiffness of the thread that spreads a step along its fibre.")
      .use(PropertyUse::Code)
      .add("Relaxation", &Options::relaxation, limits::relaxation,
        "Momentum: factor that multiplies the curvature, length and compactness costs in every iteration, so that they cannot "
        "hold an overlap open at the end. Once fewer pairs overlap than a twentieth of the capsules, its 2.5th power does so. A "
        "value nearer to 1 takes longer and gives straighter fibres.")
      .where("Method", { 0 })
      .add("PackingLimit", &Options::packingLimit, limits::packingLimit,
        "A bundle that fills more than this volume fraction of its cuboid is widened to it before its fibres are bent. Straight "
        "fibres with some dispersion cannot be packed much denser than 0.7 and stay straight. A lower limit gives straighter "
        "fibres, a higher one denser bundles.")
      .add("SafetyMargin", &Options::safetyMargin, limits::safetyMargin, "Factor by which capsules act as if they were thicker.")
      .use(PropertyUse::Code)
      .add("RadiusTolerance", &Options::radiusTolerance, limits::radiusTolerance,
        "Largest change of a radius that the optimiser may make, as a fraction of the radius. 0: all radii stay as they are.")
      .add("TimeBudget", &Options::timeBudget, limits::seconds,
        "Time limit in seconds; 0: no limit. A run that reaches it ends with its best state and a warning.")
      .add("CheckpointFile", &Options::checkpointFile,
        "File for the state of the run, from which a later run can continue (see Resume). It is written at intervals and at the "
        "end, always as a whole. Empty: no file. If the file exists and is not a checkpoint of the same fibres and parameters, "
        "it is kept, and an error says so. With a remote server, the file is on the server.")
      .use(PropertyUse::Run)
      .add(
        "CheckpointInterval", &Options::checkpointInterval, limits::seconds, "Shortest time between two checkpoints in seconds.")
      .use(PropertyUse::Run)
      .add("Resume", &Options::resume,
        "Continue from CheckpointFile if it exists; the result is the same as that of an uninterrupted run. If it does not "
        "exist, the run starts from the beginning. Off: the run starts from the beginning, and replaces its own file only once "
        "it has come as far. A file of other fibres or parameters is refused; only MaximumIterations, TimeBudget, "
        "NumberOfThreads and properties that do not change how the fibres move may differ.")
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
