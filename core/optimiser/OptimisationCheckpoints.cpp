// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OptimisationCheckpoints.h"

#include "base/AtomicFile.h"
#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Hash64.h"

#include <string>

namespace cactus
{

namespace
{

/// Number of the optimiser's method. Raise it with every change that changes results, so that no run goes on from a checkpoint of
/// another method.
constexpr int methodNumber = 1;

/// Returns a fingerprint of everything that the result depends on: the program, the input fibres and all parameters except those
/// that only say when to stop.
std::uint64_t fingerprintOf(const Fibres& fibres, const CapsuleOptimizerOptions& options)
{
  const Domain domain = fibres.domain.isPeriodic() ? fibres.domain : Domain();
  const std::string values = bytesOf(std::string(CACTUS_VERSION), methodNumber, options.overlapTolerance, options.overlapWeight,
    options.weights.curvature, options.weights.length, options.weights.radius, options.weights.compactness, options.stepSize,
    options.momentum, options.smoothing, options.relaxation, options.packingLimit, options.safetyMargin, options.radiusTolerance,
    options.method, fibres.fibreIds, fibres.bundleIds, fibres.offsets, domain.periodic, domain.lower, domain.upper);
  Hash64 print;
  print.add(values.data(), values.size());
  print.add(fibres.points.data(), fibres.points.size() * sizeof(fibres.points[0]));
  print.add(fibres.radii.data(), fibres.radii.size() * sizeof(fibres.radii[0]));
  return print.value();
}

} // namespace

OptimisationCheckpoints::OptimisationCheckpoints(
  const Fibres& fibres, const CapsuleOptimizerOptions& options, const Sharing& sharing)
  : Processes(sharing)
  , Path(options.checkpointFile)
  , Interval(options.checkpointInterval)
  , Latest(Clock::now())
{
  if (!this->Path.empty() || sharing.size() > 1)
  {
    this->Print = fingerprintOf(fibres, options);
  }
  if (!sharing.areAlike(bytesOf(
        this->Print, this->Path, options.resume, options.maximumIterations, options.timeBudget, options.checkpointInterval)))
  {
    throw InvalidInput("the ranks of this run were given different fibres or parameters, but work on one optimisation together: "
                       "give all the same, or let each work alone, as examples/sweep.py does");
  }
  if (this->Path.empty())
  {
    return;
  }
  this->File.emplace(this->Path, this->Print, sharing);
  if (this->File->found())
  {
    (*this->File)(this->Reached, this->Level);
    this->File->require(this->found());
  }
  if (!this->found() || !options.resume)
  {
    this->File.reset();
  }
  if (sharing.isFirst())
  {
    const AtomicFile attempt(this->Path); // removed again
  }
}

void OptimisationCheckpoints::load(OptimisationRun& run)
{
  this->File->require(this->Level == run.level);
  run.iteration = this->Reached;
  run.load(*this->File);
  this->File->finish();
  this->File.reset();
}

bool OptimisationCheckpoints::due() const
{
  if (this->Path.empty() || (!this->found() && !this->Written))
  {
    return !this->Path.empty();
  }
  const double sinceLatest = std::chrono::duration<double>(Clock::now() - this->Latest).count();
  return this->Processes.fromFirst(sinceLatest >= this->Interval ? "1" : "0") == "1";
}

void OptimisationCheckpoints::write(const OptimisationRun& run)
{
  this->Latest = Clock::now();
  if (this->Path.empty() || run.iteration < this->Reached)
  {
    return;
  }
  try
  {
    CheckpointWriter file(this->Path, this->Print, this->Processes);
    file(run.iteration, run.level);
    run.save(file);
    file.commit();
    this->Failure.clear();
  }
  catch (const Error& error)
  {
    if (!this->Written && !this->found())
    {
      throw;
    }
    this->Failure = error.what();
  }
  this->Written = true;
}

} // namespace cactus
