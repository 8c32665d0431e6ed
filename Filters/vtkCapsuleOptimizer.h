// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCapsuleOptimizer
 * @brief Bends fibres until no two of them overlap (CACTUS 2023, "Joint fibre optimisation").
 *
 * Input: fibres (polylines with point data `Radius`), from one connection or several, each with one block or several; bundles and
 * fibres that share ids are renumbered in the order of the connections. All inputs have to have the same `Domain`.
 *
 * Output 0 `Fibres`: the fibres, with point data `Overlap` (largest relative penetration D = 1 - d / (rp + rq) of the capsules at
 * a control point; 0 where nothing is touched) and field data `Converged` (1 or 0) and `MaximumPenetration`; and, of the whole
 * fibres before they are trimmed, `MeanDispersion` (degrees, end to end), `TangentDispersion` (degrees, by segment),
 * `CrossingAngle` (degrees; 0 for one bundle), each also with `Initial` in front, `SmallestCurvatureRadius` (µm),
 * `SmallestBendRadius` (the same as a multiple of the fibre's radius there), `LengthIncrease` (a fraction) and `RadiusDistance`
 * (Kolmogorov–Smirnov distance of the radii to those that came in). Output 1 `Convergence`: one row per iteration.
 *
 * With KeepHistory on, every HistoryInterval-th state is kept, and the iterations are offered as time steps: a request for a time
 * gets the last state that is not after it, the last one being the result. The run then takes place as soon as the times are
 * asked for.
 *
 * With ShowEvery on, the run takes place in the background: a request gets the newest of every so many states, and
 * GetNeedsUpdate() tells, as ParaView asks of live sources, when there is another one, the result at last. Its bits are those of
 * a run in the foreground. StopNow() ends it with the best state so far. In one process only.
 *
 * In a parallel run all ranks share the work, each with some of the fibres, and the result has the bits of one rank alone. All of
 * them keep it, since each is asked for a piece of its own by whatever updates this filter by itself, and for the whole by the
 * next stage; the ranks that are asked for a piece other than the first give none.
 *
 * Where overlaps above OverlapTolerance remain, because iterations or time ran out or the user stopped it, a warning says how
 * many and how large, and the output is the best state that was seen.
 */
#ifndef vtkCapsuleOptimizer_h
#define vtkCapsuleOptimizer_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkPolyDataAlgorithm.h>

#include <memory>

namespace cactus
{
struct CapsuleOptimizerStage;
} // namespace cactus

class CACTUSFILTERS_EXPORT vtkCapsuleOptimizer : public vtkPolyDataAlgorithm
{
public:
  static vtkCapsuleOptimizer* New();
  vtkTypeMacro(vtkCapsuleOptimizer, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** How gradients become steps. */
  enum DescentMethods
  {
    MOMENTUM = 0,
    ADAGRAD = 1
  };

  CACTUS_WHOLE_PROPERTY(MaximumIterations)
  CACTUS_NUMBER_PROPERTY(OverlapTolerance)
  CACTUS_WHOLE_PROPERTY(Method)
  CACTUS_NUMBER_PROPERTY(OverlapWeight)
  CACTUS_NUMBER_PROPERTY(CurvatureWeight)
  CACTUS_NUMBER_PROPERTY(LengthWeight)
  CACTUS_NUMBER_PROPERTY(RadiusWeight)
  CACTUS_NUMBER_PROPERTY(CompactnessWeight)
  CACTUS_NUMBER_PROPERTY(StepSize)
  CACTUS_NUMBER_PROPERTY(Relaxation)
  CACTUS_NUMBER_PROPERTY(PackingLimit)
  CACTUS_NUMBER_PROPERTY(RadiusTolerance)
  CACTUS_SWITCH_PROPERTY(TrimToDomain)
  CACTUS_NUMBER_PROPERTY(TimeBudget)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)
  CACTUS_FILE_PROPERTY(CheckpointFile)
  CACTUS_NUMBER_PROPERTY(CheckpointInterval)
  CACTUS_SWITCH_PROPERTY(Resume)
  CACTUS_SWITCH_PROPERTY(KeepHistory)
  CACTUS_WHOLE_PROPERTY(HistoryInterval)
  CACTUS_WHOLE_PROPERTY(ShowEvery)

  /** Whether a run in the background has something new to show; the filter is then modified. */
  bool GetNeedsUpdate();
  /** The same as a number, which scripts can ask for. */
  int GetHasNews() { return this->GetNeedsUpdate() ? 1 : 0; }

  CACTUS_ABORT_IS_NO_CHANGE

  /** Ends a run in the background: what it shows next is its best state, which is its result. */
  void StopNow();

protected:
  vtkCapsuleOptimizer();
  ~vtkCapsuleOptimizer() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  struct Run;
  struct LiveRun;

  vtkCapsuleOptimizer(const vtkCapsuleOptimizer&) = delete;
  void operator=(const vtkCapsuleOptimizer&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;

  /** The values of the properties, not checked. */
  const cactus::CapsuleOptimizerStage& Stage() const;
  /** Runs the optimisation, which all ranks share, unless LastRun holds it in all of them; throws what it throws, or threw. */
  void EnsureRun(vtkInformationVector* inputs);
  void NoteStop();
  /** Whether LastRun holds what would come out. */
  bool IsRunKnown(vtkInformationVector* inputs);
  /** Runs the optimisation. */
  void Optimise(vtkInformationVector* inputs, Run& run);
  /** Runs the optimisation in the background, unless it does already, and gives what there is of it. */
  Run& LookAtRun(vtkInformationVector* inputs);
  /** Fills the outputs with the state that is asked for. */
  void ShowWanted(const Run& run, vtkInformation* request, vtkInformationVector* outputs);
  /** Fills the outputs with a state of the run. */
  void Show(const Run& run, std::size_t state, vtkInformationVector* outputs);
  /** Says which times there are. */
  void OfferTimes(vtkInformationVector* outputs) const;

  /** Warns of what the run has not reached, once. */
  void Report(Run& run);

  std::unique_ptr<Run> LastRun;  ///< kept where KeepHistory is on, and where there are several ranks
  std::unique_ptr<LiveRun> Live; ///< the run in the background
};

#endif
