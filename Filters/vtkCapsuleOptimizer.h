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
 * Where overlaps above OverlapTolerance remain, because iterations or time ran out or the user stopped it, a warning says how
 * many and how large, and the output is the best state that was seen.
 */
#ifndef vtkCapsuleOptimizer_h
#define vtkCapsuleOptimizer_h

#include "CactusFiltersModule.h"

#include <vtkPolyDataAlgorithm.h>

#include <memory>

namespace cactus
{
struct CapsuleOptimizerOptions;
class RankAgreement;
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

  ///@{
  /** Iterations after which to give up. */
  vtkSetMacro(MaximumIterations, int);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /** Largest relative penetration D = 1 - d / (rp + rq) allowed between capsules of different fibres. */
  vtkSetMacro(OverlapTolerance, double);
  vtkGetMacro(OverlapTolerance, double);
  ///@}

  ///@{
  /** MOMENTUM (preconditioned heavy ball) or ADAGRAD (as in the paper). */
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /** Weight of the overlap cost. */
  vtkSetMacro(OverlapWeight, double);
  vtkGetMacro(OverlapWeight, double);
  ///@}

  ///@{
  /** Weight of the curvature cost. */
  vtkSetMacro(CurvatureWeight, double);
  vtkGetMacro(CurvatureWeight, double);
  ///@}

  ///@{
  /** Weight of the length cost. */
  vtkSetMacro(LengthWeight, double);
  vtkGetMacro(LengthWeight, double);
  ///@}

  ///@{
  /** Weight of the radius cost; acts where RadiusTolerance is above 0. */
  vtkSetMacro(RadiusWeight, double);
  vtkGetMacro(RadiusWeight, double);
  ///@}

  ///@{
  /** Weight of the compactness cost. */
  vtkSetMacro(CompactnessWeight, double);
  vtkGetMacro(CompactnessWeight, double);
  ///@}

  ///@{
  /** MOMENTUM: part of the Newton step along the fibre that is taken. ADAGRAD: length of the first step in µm. */
  vtkSetMacro(StepSize, double);
  vtkGetMacro(StepSize, double);
  ///@}

  ///@{
  /** Factor by which curvature, length and compactness fade in each iteration (MOMENTUM). */
  vtkSetMacro(Relaxation, double);
  vtkGetMacro(Relaxation, double);
  ///@}

  ///@{
  /** Share of its cuboid above which a bundle is widened. */
  vtkSetMacro(PackingLimit, double);
  vtkGetMacro(PackingLimit, double);
  ///@}

  ///@{
  /** Largest change of a radius as a fraction of it; 0 keeps radii. */
  vtkSetMacro(RadiusTolerance, double);
  vtkGetMacro(RadiusTolerance, double);
  ///@}

  ///@{
  /** Cut away what lies outside the domain. */
  vtkSetMacro(TrimToDomain, bool);
  vtkGetMacro(TrimToDomain, bool);
  vtkBooleanMacro(TrimToDomain, bool);
  ///@}

  ///@{
  /** Seconds after which to stop with the best state; 0 for no limit. */
  vtkSetMacro(TimeBudget, double);
  vtkGetMacro(TimeBudget, double);
  ///@}

  ///@{
  /** Threads to use; 0 takes all. The result does not depend on it. */
  vtkSetMacro(NumberOfThreads, int);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /** File to which the state of the run is written every CheckpointInterval seconds and when it ends; empty for none. */
  vtkSetFilePathMacro(CheckpointFile);
  vtkGetFilePathMacro(CheckpointFile);
  ///@}

  ///@{
  /** Least seconds between two checkpoints. */
  vtkSetMacro(CheckpointInterval, double);
  vtkGetMacro(CheckpointInterval, double);
  ///@}

  ///@{
  /** Go on from CheckpointFile where it exists; an error where it belongs to other fibres or other parameters. */
  vtkSetMacro(Resume, bool);
  vtkGetMacro(Resume, bool);
  vtkBooleanMacro(Resume, bool);
  ///@}

  ///@{
  /** Keep states of the run and offer them as time steps; 12 bytes per control point and state, 16 where radii may change. */
  vtkSetMacro(KeepHistory, bool);
  vtkGetMacro(KeepHistory, bool);
  vtkBooleanMacro(KeepHistory, bool);
  ///@}

  ///@{
  /** Iterations from one state that is kept to the next. */
  vtkSetMacro(HistoryInterval, int);
  vtkGetMacro(HistoryInterval, int);
  ///@}

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

  vtkCapsuleOptimizer(const vtkCapsuleOptimizer&) = delete;
  void operator=(const vtkCapsuleOptimizer&) = delete;

  /** The properties as core takes them; throws cactus::InvalidInput for one out of range. */
  cactus::CapsuleOptimizerOptions Options() const;
  /** Runs the optimisation unless LastRun holds it; throws what it throws, or threw. */
  void EnsureRun(vtkInformationVector* inputs, cactus::RankAgreement& agreement);
  /** Runs the optimisation. */
  void Optimise(vtkInformationVector* inputs, cactus::RankAgreement& agreement, Run& run);
  /** Fills the outputs with a state of the run. */
  void Show(const Run& run, std::size_t state, vtkInformationVector** inputs, vtkInformationVector* outputs);
  /** Says which times there are. */
  void OfferTimes(vtkInformationVector* outputs) const;

  std::unique_ptr<Run> LastRun; ///< kept where KeepHistory is on

  int MaximumIterations = 3000;
  double OverlapTolerance = 1e-3;
  int Method = MOMENTUM;
  double OverlapWeight = 1.0;
  double CurvatureWeight = 10.0;
  double LengthWeight = 10.0;
  double RadiusWeight = 1.0;
  double CompactnessWeight = 2.0;
  double StepSize = 1.7;
  double Relaxation = 0.96;
  double PackingLimit = 0.7;
  double RadiusTolerance = 0.0;
  bool TrimToDomain = true;
  double TimeBudget = 0.0;
  int NumberOfThreads = 0;
  char* CheckpointFile = nullptr;
  double CheckpointInterval = 600.0;
  bool Resume = false;
  bool KeepHistory = false;
  int HistoryInterval = 10;
};

#endif
