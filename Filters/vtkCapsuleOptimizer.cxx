// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCapsuleOptimizer.h"

#include "BackgroundOptimisation.h"
#include "Columns.h"
#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "InputBlocks.h"
#include "RankTeam.h"
#include "Ranks.h"
#include "StageProperties.h"
#include "StopSignals.h"
#include "WholeData.h"
#include "base/Context.h"
#include "base/Error.h"
#include "base/Sharing.h"
#include "fibres/FibreShape.h"
#include "optimiser/CapsuleOptimizer.h"
#include "optimiser/OverlapReport.h"
#include "stages/StageWork.h"

#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkCapsuleOptimizer);

namespace
{

/// Returns the data of all connections.
std::vector<vtkDataObject*> dataOf(vtkInformationVector* inputs)
{
  std::vector<vtkDataObject*> data;
  data.reserve(static_cast<std::size_t>(inputs->GetNumberOfInformationObjects()));
  for (int connection = 0; connection < inputs->GetNumberOfInformationObjects(); ++connection)
  {
    data.push_back(vtkDataObject::GetData(inputs, connection));
  }
  return data;
}

template <typename Value>
void addColumn(
  vtkTable* table, const char* name, const std::vector<cactus::ConvergenceRow>& rows, Value cactus::ConvergenceRow::*member)
{
  cactus::addColumn<vtkDoubleArray>(table, name, rows.size(), [&](std::size_t row) { return rows[row].*member; });
}

void fillTable(const std::vector<cactus::ConvergenceRow>& rows, vtkTable* table)
{
  using Row = cactus::ConvergenceRow;
  addColumn(table, "Iteration", rows, &Row::iteration);
  addColumn(table, "OverlapCost", rows, &Row::overlapCost);
  addColumn(table, "MaximumPenetration", rows, &Row::maximumPenetration);
  addColumn(table, "OverlappingPairs", rows, &Row::overlappingPairs);
  addColumn(table, "CurvatureCost", rows, &Row::curvatureCost);
  addColumn(table, "LengthCost", rows, &Row::lengthCost);
  addColumn(table, "RadiusCost", rows, &Row::radiusCost);
  addColumn(table, "CompactnessCost", rows, &Row::compactnessCost);
  addColumn(table, "Seconds", rows, &Row::seconds);
}

/// Requests the inputs' last time: the times of a run that offers its states are iterations, which the inputs do not know.
void askForLastTime(vtkInformationVector* inputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* info = inputs->GetInformationObject(i);
    const int count = info->Has(Pipeline::TIME_STEPS()) != 0 ? info->Length(Pipeline::TIME_STEPS()) : 0;
    if (count > 0)
    {
      info->Set(Pipeline::UPDATE_TIME_STEP(), info->Get(Pipeline::TIME_STEPS(), count - 1));
    }
    else
    {
      info->Remove(Pipeline::UPDATE_TIME_STEP());
    }
  }
}

/// Returns the newest change of any input.
vtkMTimeType inputTime(vtkInformationVector* inputs)
{
  vtkMTimeType newest = 0;
  for (vtkDataObject* data : dataOf(inputs))
  {
    newest = std::max(newest, cactus::changeTime(data));
  }
  return newest;
}

} // namespace

/// The state of a finished or running optimisation.
struct vtkCapsuleOptimizer::Run
{
  vtkMTimeType ParameterTime = 0;
  vtkMTimeType InputTime = 0;
  std::exception_ptr Failure;              ///< exception instead of a result
  cactus::Fibres Fibres;                   ///< the result
  cactus::OptimisationResult Optimisation; ///< statistics of the run
  cactus::FibreShape Before;
  double RadiusDistance = 0.0;
  bool WasReported = false; ///< whether the user has been told what went wrong
  bool IsOver = true;       ///< otherwise Fibres are an intermediate state

  /// An intermediate state, in single precision.
  struct State
  {
    int Iteration = 0;
    std::vector<Eigen::Vector3f> Points;
    std::vector<float> Radii; ///< empty if they do not change
  };
  std::vector<State> States;
  std::vector<double> InitialRadii;

  int lastIteration() const { return this->Optimisation.convergence.back().iteration; }

  std::vector<double> times() const
  {
    std::vector<double> times;
    for (const State& state : this->States)
    {
      times.push_back(state.Iteration);
    }
    times.push_back(this->lastIteration());
    return times;
  }
};

/// A run in the background, and its states that were shown.
struct vtkCapsuleOptimizer::LiveRun
{
  LiveRun(const cactus::Fibres& fibres, const cactus::CapsuleOptimizerStage& stage)
    : Start(fibres)
    , Optimisation(fibres, stage.options, stage.threads, stage.showEvery)
  {
    cactus::resampleDenseFibres(this->Start); // radii are compared at the same control points
    this->Seen.Before = cactus::measureShape(fibres);
    this->Seen.IsOver = false;
  }

  cactus::Fibres Start;
  vtkMTimeType ParameterTime = 0;
  vtkMTimeType InputTime = 0;
  Run Seen;
  cactus::BackgroundOptimisation Optimisation;
};

vtkCapsuleOptimizer::vtkCapsuleOptimizer()
  : Properties(cactus::makeProperties<cactus::CapsuleOptimizerStage>())
{
  this->SetNumberOfOutputPorts(2);
}

vtkCapsuleOptimizer::~vtkCapsuleOptimizer() = default;

int vtkCapsuleOptimizer::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

int vtkCapsuleOptimizer::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkTable");
  return 1;
}

int vtkCapsuleOptimizer::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 1);
  if (this->Stage().keepHistory)
  {
    askForLastTime(inputs[0]);
  }
  return 1;
}

void vtkCapsuleOptimizer::OfferTimes(vtkInformationVector* outputs) const
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* info = outputs->GetInformationObject(port);
    if (!this->Stage().keepHistory)
    {
      continue; // the input's times, if it has any
    }
    if (!this->LastRun || this->LastRun->Failure)
    {
      info->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
      info->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
      continue;
    }
    const std::vector<double> times = this->LastRun->times();
    const double range[2] = { times.front(), times.back() };
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  }
}

int vtkCapsuleOptimizer::RequestInformation(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (this->Stage().keepHistory)
  {
    // Only the run itself determines the times, and later stages request them here, not after RequestData.
    const cactus::StopSignals signals;
    cactus::quietly(
      [&]
      {
        askForLastTime(inputs[0]);
        cactus::updateWholeInputs(this, inputs);
        this->EnsureRun(inputs[0]);
      });
    this->NoteStop();
  }
  this->OfferTimes(outputs);
  return 1;
}

bool vtkCapsuleOptimizer::IsRunKnown(vtkInformationVector* inputs)
{
  const bool isKept = this->Stage().keepHistory || (cactus::processCount() > 1 && this->LastRun && !this->LastRun->Failure);
  return isKept && this->LastRun && this->LastRun->ParameterTime == this->GetMTime() &&
         this->LastRun->InputTime == inputTime(inputs);
}

void vtkCapsuleOptimizer::NoteStop()
{
  if (!this->LastRun || !this->LastRun->Failure || !cactus::StopSignals::areCaught())
  {
    return;
  }
  try
  {
    std::rethrow_exception(this->LastRun->Failure);
  }
  catch (const cactus::Cancelled& stop)
  {
    cactus::noteStopped(this, stop.what());
  }
  catch (...)
  {
    return; // RequestData reports the error
  }
}

void vtkCapsuleOptimizer::EnsureRun(vtkInformationVector* inputs)
{
  cactus::RankTeam ranks;
  const cactus::Sharing sharing(&ranks);
  if (!sharing.isEverywhere(this->IsRunKnown(inputs)))
  {
    this->LastRun.reset();
    auto run = std::make_unique<Run>();
    run->InputTime = inputTime(inputs);
    try
    {
      sharing.together(
        [&]
        {
          this->Optimise(inputs, *run);
          if (cactus::StopSignals::areCaught())
          {
            throw cactus::Cancelled(); // the best state so far would be taken for the result
          }
        });
    }
    catch (...)
    {
      // Kept, so that RequestData reports the failure of a run in RequestInformation without running it again.
      run->Failure = std::current_exception();
    }
    run->ParameterTime = this->GetMTime(); // only now: being stopped modifies the filter
    this->LastRun = std::move(run);
  }
  if (this->LastRun->Failure)
  {
    std::rethrow_exception(this->LastRun->Failure);
  }
}

const cactus::CapsuleOptimizerStage& vtkCapsuleOptimizer::Stage() const
{
  return cactus::stageOf<cactus::CapsuleOptimizerStage>(this->Properties);
}

void vtkCapsuleOptimizer::Optimise(vtkInformationVector* inputs, Run& run)
{
  const cactus::CapsuleOptimizerStage& stage = this->Stage();
  cactus::validateProperties(stage);
  cactus::validate(stage.options);
  const cactus::Context context = cactus::contextFor(this, stage.threads);
  run.Fibres = cactus::joinedFibres(dataOf(inputs));
  run.Before = cactus::measureShape(run.Fibres);
  cactus::Fibres before = run.Fibres;
  cactus::resampleDenseFibres(before);                // as optimise() does: radii are compared at the same control points
  std::vector<Eigen::Vector3d>().swap(before.points); // only radii are compared
  const auto keep = [&](const cactus::ConvergenceRow& row, const cactus::Fibres& fibres)
  {
    if (row.iteration % stage.historyInterval != 0)
    {
      return;
    }
    Run::State state;
    state.Iteration = row.iteration;
    state.Points.reserve(fibres.points.size());
    for (const Eigen::Vector3d& point : fibres.points)
    {
      state.Points.push_back(point.cast<float>());
    }
    if (stage.options.radiusTolerance > 0.0)
    {
      state.Radii.assign(fibres.radii.begin(), fibres.radii.end());
    }
    run.States.push_back(std::move(state));
  };
  std::function<void(const cactus::ConvergenceRow&, const cactus::Fibres&)> observe;
  if (stage.keepHistory)
  {
    observe = keep;
  }
  cactus::RankTeam ranks;
  run.Optimisation = cactus::optimise(run.Fibres, stage.options, context, observe, &ranks);
  run.RadiusDistance = cactus::radiusDistance(before, run.Fibres);
  // The result replaces the last state.
  while (!run.States.empty() && run.States.back().Iteration >= run.lastIteration())
  {
    run.States.pop_back();
  }
}

vtkCapsuleOptimizer::Run& vtkCapsuleOptimizer::LookAtRun(vtkInformationVector* inputs)
{
  const cactus::CapsuleOptimizerStage& stage = this->Stage();
  if (!this->Live || this->Live->ParameterTime != this->GetMTime() || this->Live->InputTime != inputTime(inputs))
  {
    this->LastRun.reset();
    this->Live.reset();
    cactus::validateProperties(stage);
    cactus::validate(stage.options);
    if (cactus::processCount() > 1)
    {
      throw cactus::InvalidInput(cactus::text("ShowEvery is ", stage.showEvery,
        ", but states are shown in one process only, and this run has ", cactus::processCount(), ": set it to 0"));
    }
    this->Live = std::make_unique<LiveRun>(cactus::joinedFibres(dataOf(inputs)), stage);
    this->Live->ParameterTime = this->GetMTime();
    this->Live->InputTime = inputTime(inputs);
  }
  Run& seen = this->Live->Seen;
  cactus::BackgroundOptimisation& optimisation = this->Live->Optimisation;
  if (seen.IsOver)
  {
    return seen;
  }
  if (optimisation.isOver())
  {
    seen.Optimisation = optimisation.result(seen.Fibres);
    seen.IsOver = true;
  }
  else
  {
    cactus::BackgroundOptimisation::State state = optimisation.take();
    const cactus::OverlapReport report =
      cactus::measureOverlap(state.fibres, stage.options.overlapTolerance, cactus::contextFor(this, stage.threads).threadCount());
    seen.Fibres = std::move(state.fibres);
    seen.Optimisation.reason = cactus::StopReason::Stopped;
    seen.Optimisation.convergence = std::move(state.rows);
    seen.Optimisation.overlap = report.perPoint;
    seen.Optimisation.maximumPenetration = std::max(0.0, report.largestPenetration);
  }
  seen.RadiusDistance = cactus::radiusDistance(this->Live->Start, seen.Fibres);
  return seen;
}

bool vtkCapsuleOptimizer::GetNeedsUpdate()
{
  if (!this->Live || this->Live->ParameterTime != this->GetMTime() || !this->Live->Optimisation.hasNews())
  {
    return false;
  }
  this->Modified();
  this->Live->ParameterTime = this->GetMTime();
  return true;
}

void vtkCapsuleOptimizer::StopNow()
{
  if (this->Live)
  {
    this->Live->Optimisation.stop();
  }
}

void vtkCapsuleOptimizer::Report(Run& run)
{
  if (run.IsOver && !run.WasReported)
  {
    for (const std::string& remark : cactus::remarksOnOptimisation(run.Optimisation, this->Stage().options))
    {
      vtkWarningMacro(<< remark);
    }
    run.WasReported = true;
  }
}

void vtkCapsuleOptimizer::Show(const Run& run, std::size_t state, vtkInformationVector* outputs)
{
  const cactus::CapsuleOptimizerStage& stage = this->Stage();
  const bool isResult = run.IsOver && state >= run.States.size();
  cactus::Fibres fibres = run.Fibres;
  std::vector<double> overlaps = run.Optimisation.overlap;
  double penetration = run.Optimisation.maximumPenetration;
  if (state < run.States.size())
  {
    const Run::State& then = run.States[state];
    for (std::size_t i = 0; i < fibres.points.size(); ++i)
    {
      fibres.points[i] = then.Points[i].cast<double>();
    }
    if (!then.Radii.empty())
    {
      fibres.radii.assign(then.Radii.begin(), then.Radii.end());
    }
    const int threads = cactus::contextFor(this, stage.threads).threadCount();
    const cactus::OverlapReport report = cactus::measureOverlap(fibres, stage.options.overlapTolerance, threads);
    overlaps = report.perPoint;
    penetration = std::max(0.0, report.largestPenetration);
  }
  const cactus::FibreShape after = cactus::measureShape(fibres);

  auto* output = vtkPolyData::GetData(outputs, 0);
  std::vector<std::size_t> kept;
  fibres = cactus::trimmedFibres(stage, std::move(fibres), kept);
  cactus::toPolyData(fibres, output);
  cactus::addColumn<vtkDoubleArray>(
    output->GetPointData(), "Overlap", kept.size(), [&](std::size_t i) { return overlaps[kept[i]]; });

  vtkFieldData* data = output->GetFieldData();
  cactus::addCount(data, "Converged", penetration <= stage.options.overlapTolerance ? 1 : 0);
  cactus::addNumber(data, "MaximumPenetration", penetration);
  cactus::addNumber(data, "InitialMeanDispersion", run.Before.meanDispersion);
  cactus::addNumber(data, "MeanDispersion", after.meanDispersion);
  cactus::addNumber(data, "InitialTangentDispersion", run.Before.tangentDispersion);
  cactus::addNumber(data, "TangentDispersion", after.tangentDispersion);
  cactus::addNumber(data, "InitialCrossingAngle", run.Before.crossingAngle);
  cactus::addNumber(data, "CrossingAngle", after.crossingAngle);
  cactus::addNumber(data, "SmallestBendRadius", after.smallestBendRadius);
  cactus::addNumber(data, "SmallestCurvatureRadius", after.smallestCurvatureRadius);
  cactus::addNumber(data, "LengthIncrease", after.totalLength / run.Before.totalLength - 1.0);
  cactus::addNumber(data, "RadiusDistance", run.RadiusDistance);

  const int iterations = state < run.States.size() ? run.States[state].Iteration : run.lastIteration();
  cactus::setProvenance(output,
    cactus::recordOf(this, "CapsuleOptimizer", stage, { "Input" },
      cactus::optimiserReached(iterations, penetration, run.Optimisation.reason, isResult)),
    0);
  fillTable(run.Optimisation.convergence, vtkTable::GetData(outputs, 1));
}

void vtkCapsuleOptimizer::ShowWanted(const Run& run, vtkInformation* request, vtkInformationVector* outputs)
{
  if (!this->Stage().keepHistory)
  {
    this->Show(run, run.States.size(), outputs);
    return;
  }
  const std::vector<double> times = run.times();
  double time = run.lastIteration();
  // The other port may still hold an older requested time.
  const int from = request->Has(vtkExecutive::FROM_OUTPUT_PORT()) ? request->Get(vtkExecutive::FROM_OUTPUT_PORT()) : 0;
  vtkInformation* info = outputs->GetInformationObject(std::max(from, 0));
  if (info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    time = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
  }
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  this->Show(run, after == times.begin() ? 0 : static_cast<std::size_t>(after - times.begin()) - 1, outputs);
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject::GetData(outputs, port)->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
}

int vtkCapsuleOptimizer::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  cactus::RankTeam ranks;
  const cactus::Sharing sharing(&ranks);
  return cactus::guarded(this, sharing,
    [&]
    {
      // Ranks without output share the work, too.
      const bool isAsked = cactus::ownsWholeOutput(request, outputs);
      Run* run = nullptr;
      if (this->Stage().showEvery > 0 && !this->Stage().keepHistory)
      {
        sharing.together([&] { run = &this->LookAtRun(inputs[0]); });
      }
      else
      {
        this->Live.reset();
        this->EnsureRun(inputs[0]);
        run = this->LastRun.get();
      }
      if (isAsked)
      {
        this->ShowWanted(*run, request, outputs);
      }
      if (sharing.isFirst())
      {
        this->Report(*run);
      }
      if (!this->Stage().keepHistory && sharing.size() == 1)
      {
        this->LastRun.reset();
      }
    });
}
