// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OptimisationCheckpoints.h"

#include "base/Bytes.h"
#include "base/Checkpoint.h"
#include "base/Error.h"
#include "base/Hash64.h"

#include <array>
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
  const std::string program = CACTUS_VERSION;
  const std::array<double, 15> values{ double(methodNumber), options.overlapTolerance, options.overlapWeight,
    options.weights.curvature, options.weights.length, options.weights.radius, options.weights.compactness, options.stepSize,
    options.momentum, options.smoothing, options.relaxation, options.packingLimit, options.safetyMargin, options.radiusTolerance,
    double(options.method) };
  Hash64 print;
  print.add(program.data(), program.size());
  print.add(values.data(), sizeof(values));
  const auto add = [&print](const auto& column) { print.add(column.data(), column.size() * sizeof(column[0])); };
  add(fibres.fibreIds);
  add(fibres.bundleIds);
  add(fibres.offsets);
  add(fibres.points);
  add(fibres.radii);
  if (fibres.domain.isPeriodic())
  {
    add(fibres.domain.periodic);
    print.add(fibres.domain.lower.data(), 3 * sizeof(double));
    print.add(fibres.domain.upper.data(), 3 * sizeof(double));
  }
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
    this->requireAlike(options);
  }
  if (!this->Path.empty() && sharing.isFirst())
  {
    const auto found = findCheckpoint(this->Path, this->Print);
    this->Reached = found ? found->iteration : -1;
    if (found && options.resume)
    {
      this->Level = OptimisationRun::levelOf(this->Path, this->Print);
    }
    // Removed again unless it is committed.
    const CheckpointWriter attempt(this->Path, { this->Print, 0 });
  }
  ByteWriter reached;
  reached(this->Reached);
  reached(static_cast<std::uint8_t>(this->Level));
  const std::string told = sharing.fromFirst(reached.bytes());
  ByteReader get(told);
  get(this->Reached);
  this->Level = get.get<std::uint8_t>() == OptimisationRun::Coarse ? OptimisationRun::Coarse : OptimisationRun::Fine;
}

/// Throws unless all processes were given the same run.
void OptimisationCheckpoints::requireAlike(const CapsuleOptimizerOptions& options) const
{
  ByteWriter mine;
  mine(this->Print);
  mine(options.checkpointFile);
  mine(static_cast<std::uint8_t>(options.resume));
  mine(options.maximumIterations);
  mine(options.timeBudget);
  mine(options.checkpointInterval);
  for (const std::string& other : this->Processes.exchange(mine.bytes()))
  {
    if (other != mine.bytes())
    {
      throw InvalidInput(
        "the ranks of this run were given different fibres or parameters, but work on one optimisation together: "
        "give all the same, or let each work alone, as examples/sweep.py does");
    }
  }
}

void OptimisationCheckpoints::load(OptimisationRun& run) const
{
  run.load(this->Path, this->Print);
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
    run.save(this->Path, this->Print);
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
