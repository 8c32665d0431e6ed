// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMyelinSurface
 * @brief Closed outer and inner surfaces of all fibres of a label image, with myelin of the thickness asked for.
 *
 * Input: the image that vtkFibreRadialGrowth makes, with its field data. Output 0 `Outer` and 1 `Inner`: triangles with cell data
 * `FibreId`, `BundleId` and `Surface` (0 outer, 1 inner), in increasing order of fibres, which share no points; field data
 * `Domain` and `Provenance`. Output 2 `Fibre statistics`: a table with one row per fibre of the image's FibreTable.
 *
 * Each surface is a closed, outward 2-manifold, cut off flat at the faces of the domain; inner caps lie a little
 * inside the outer ones. The method, what it guarantees and where the limits are stand in core/surface/MyelinSurface.h; the
 * contouring is core/mesh/Isosurface.h, since marching cubes does not promise a manifold.
 *
 * The column `Myelin` tells how a fibre came out: 0 as asked; 1 thinner than asked, since the axon would break; 2
 * thicker than asked, since myelin is at least MinimumGap thick; 3 without an inner surface, since the fibre is too thin for
 * both; 4 too few voxels of the image, or none, belong to the fibre, which has neither surface. `Flawed` is 1 where a fault could
 * not be mended. One warning counts what did not come out as asked. Field data `WantedFibres` of output 0, the ids of the fibres
 * that were to have a surface, and `MinimumGap` of both (µm) let a certificate tell what is missing.
 *
 * All of the image is needed at once. Where the pipeline runs on several ranks, the first one gives the result.
 */
#ifndef vtkMyelinSurface_h
#define vtkMyelinSurface_h

#include "CactusFiltersModule.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkMyelinSurface : public vtkPolyDataAlgorithm
{
public:
  static vtkMyelinSurface* New();
  vtkTypeMacro(vtkMyelinSurface, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Values of GRatioModel. */
  enum
  {
    CONSTANT = 0,
    LOG_LINEAR = 1,
    DISTRIBUTED = 2,
    TARGET_AXON_VOLUME_FRACTION = 3
  };

  ///@{
  /** How the thickness of the myelin is found. */
  vtkSetMacro(GRatioModel, int);
  vtkGetMacro(GRatioModel, int);
  ///@}

  ///@{
  /** Ratio of inner to outer diameter (CONSTANT), or the mean of it over the fibres (DISTRIBUTED). */
  vtkSetMacro(GRatio, double);
  vtkGetMacro(GRatio, double);
  ///@}

  ///@{
  /** Standard deviation of the g-ratio over the fibres (DISTRIBUTED). */
  vtkSetMacro(GRatioDeviation, double);
  vtkGetMacro(GRatioDeviation, double);
  ///@}

  ///@{
  /** Fraction of the domain that the axons are to fill (TARGET_AXON_VOLUME_FRACTION). */
  vtkSetMacro(TargetAxonVolumeFraction, double);
  vtkGetMacro(TargetAxonVolumeFraction, double);
  ///@}

  ///@{
  /** How often the fibres' fields are smoothed before they are contoured. */
  vtkSetMacro(SmoothingIterations, int);
  vtkGetMacro(SmoothingIterations, int);
  ///@}

  ///@{
  /** Distance (µm) by which coarsening may move a surface, an aim and no strict bound; 0: no coarsening. */
  vtkSetMacro(DecimationError, double);
  vtkGetMacro(DecimationError, double);
  ///@}

  ///@{
  /** Cut off at the faces of the domain; else where the image ends. */
  vtkSetMacro(ClipToDomain, bool);
  vtkGetMacro(ClipToDomain, bool);
  vtkBooleanMacro(ClipToDomain, bool);
  ///@}

  ///@{
  /** Seed of the fibres' g-ratios (DISTRIBUTED). */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  /** Values of Meshing. */
  enum
  {
    CACTUS_MESHING = 0,
    VTK_MESHING = 1
  };

  ///@{
  /**
   * What makes the surfaces: CACTUS_MESHING, core's own contouring, coarsening and spacing, with its guarantees; or VTK_MESHING,
   * vtkFlyingEdges3D on each fibre's field, vtkWindowedSincPolyDataFilter and vtkQuadricDecimation, which promise nothing. What
   * then is at fault is marked in the column `Flawed`. SmoothingIterations and DecimationError are of the first, the next three
   * of the second.
   */
  vtkSetMacro(Meshing, int);
  vtkGetMacro(Meshing, int);
  ///@}

  ///@{
  /** Iterations of vtkWindowedSincPolyDataFilter (VTK_MESHING), 0 to 500; 0 leaves the contour as it is. */
  vtkSetMacro(SincIterations, int);
  vtkGetMacro(SincIterations, int);
  ///@}

  ///@{
  /** Its pass band, above 0 to 2: the lower, the smoother. */
  vtkSetMacro(SincPassBand, double);
  vtkGetMacro(SincPassBand, double);
  ///@}

  ///@{
  /** Part of the triangles that vtkQuadricDecimation takes away (VTK_MESHING), 0 to 0.99. */
  vtkSetMacro(TargetReduction, double);
  vtkGetMacro(TargetReduction, double);
  ///@}

  ///@{
  /** Give the label image's memory back once the surfaces are made; what else needs the image makes it anew. */
  vtkSetMacro(ReleaseInput, bool);
  vtkGetMacro(ReleaseInput, bool);
  vtkBooleanMacro(ReleaseInput, bool);
  ///@}

  ///@{
  /** Threads to use; 0 means all. The result does not depend on it. */
  vtkSetMacro(NumberOfThreads, int);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /** Counts as changed after it was stopped, so that it is asked again and says so. */
  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time) override;

protected:
  vtkMyelinSurface();
  ~vtkMyelinSurface() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMyelinSurface(const vtkMyelinSurface&) = delete;
  void operator=(const vtkMyelinSurface&) = delete;

  int GRatioModel = CONSTANT;
  double GRatio = 0.7;
  double GRatioDeviation = 0.04;
  double TargetAxonVolumeFraction = 0.0;
  int SmoothingIterations = 2;
  double DecimationError = 0.005;
  bool ClipToDomain = true;
  int Seed = 1;
  int Meshing = CACTUS_MESHING;
  int SincIterations = 20;
  double SincPassBand = 0.1;
  double TargetReduction = 0.9;
  bool ReleaseInput = false;
  int NumberOfThreads = 0;
};

#endif
