// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCapsuleOptimizer
 * @brief Bends fibres until no two of them overlap (CACTUS 2023, "Joint fibre optimisation").
 *
 * Input: fibres (polylines with point data `Radius`), from one or several connections, each with one or several blocks; bundles
 * and fibres that share ids are renumbered in the order of the connections. All inputs need the same `Domain`.
 *
 * Output 0 `Fibres`: the fibres, with point data `Overlap` (largest relative penetration D = 1 - d / (rp + rq) of the capsules at
 * a control point; 0 without contact) and field data `Converged` (1 or 0) and `MaximumPenetration`; and, for the whole fibres
 * before they are trimmed, `MeanDispersion` (degrees, end to end), `TangentDispersion` (degrees, by segment), `CrossingAngle`
 * (degrees; 0 for one bundle), each also with the prefix `Initial`, `SmallestCurvatureRadius` (µm), `SmallestBendRadius` (the
 * same as a multiple of the fibre's radius there), `LengthIncrease` (a fraction) and `RadiusDistance` (Kolmogorov–Smirnov
 * distance of the radii to the input's). Output 1 `Convergence`: one row per iteration.
 *
 * With KeepHistory on, every HistoryInterval-th state is kept, and the iterations are offered as time steps: a request for a time
 * gets the last state that is not after it; the last state is the result. The run then takes place as soon as the times are
 * requested.
 *
 * With ShowEvery on, the run takes place in the background: a request gets the newest of every ShowEvery-th state, and
 * GetNeedsUpdate() tells, like ParaView's live sources, when there is another one, finally the result. Its bits are those of a
 * run in the foreground. StopNow() ends it with the best state so far. In one process only.
 *
 * In a parallel run all ranks share the work, each with some of the fibres, and the result has the bits of a single rank. All of
 * them keep it: an update of this filter asks each for its own piece, and the next stage asks for the whole. Ranks that are asked
 * for a piece other than the first return none.
 *
 * If overlaps above OverlapTolerance remain, because iterations or time ran out or the user stopped it, a warning says how many
 * and how large, and the output is the best state found.
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
  CACTUS_PRINTS_PROPERTIES

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

  /** Tells whether a run in the background has something new to show; the filter is then modified. */
  bool GetNeedsUpdate();
  /** Tells the same as a number, for scripts. */
  int GetHasNews() { return this->GetNeedsUpdate() ? 1 : 0; }

  CACTUS_ABORT_IS_NO_CHANGE

  /** Ends a run in the background: its next and last state is its best one. */
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

  /** Returns the values of the properties, unchecked. */
  const cactus::CapsuleOptimizerStage& Stage() const;
  /** Runs the optimisation, shared by all ranks, unless LastRun holds it in all of them; throws its exception, or a kept one. */
  void EnsureRun(vtkInformationVector* inputs);
  void NoteStop();
  /** Tells whether LastRun holds the present result. */
  bool IsRunKnown(vtkInformationVector* inputs);
  /** Runs the optimisation. */
  void Optimise(vtkInformationVector* inputs, Run& run);
  /** Starts the optimisation in the background, unless it is running, and returns its present state. */
  Run& LookAtRun(vtkInformationVector* inputs);
  /** Fills the outputs with the requested state. */
  void ShowWanted(const Run& run, vtkInformation* request, vtkInformationVector* outputs);
  /** Fills the outputs with a state of the run. */
  void Show(const Run& run, std::size_t state, vtkInformationVector* outputs);
  /** Announces the available times. */
  void OfferTimes(vtkInformationVector* outputs) const;

  /** Warns once about what the run has not reached. */
  void Report(Run& run);

  std::unique_ptr<Run> LastRun;  ///< kept if KeepHistory is on, and on several ranks
  std::unique_ptr<LiveRun> Live; ///< the run in the background
};

#endif
