// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFibreRadialGrowth
 * @brief Grows fibres outwards from seeds in their capsules until they meet, as a label image with sub-voxel depth.
 *
 * All fibres grow at the same speed until they have grown by `GrowthIterations` voxels, or fill `TargetFibreVolumeFraction` of
 * the domain, or meet a neighbour, from which they keep `MinimumGap` (paper, section "Fibre radial growth"; what is computed is
 * the limit of that method for small voxels, see core/growth/FibreRadialGrowth.h). No voxel belongs to two fibres, also where
 * capsules overlap. For a target fraction the capsules' radii are changed first, so that each fibre ends at its TargetRadius
 * where these add up to the fraction (core/growth/GrowthTarget.h).
 *
 * Input: fibres (polylines with point data `Radius`). Output: an image of cubic voxels that fill the field data `Domain`, its
 * points the voxels' centres, with
 * - point data `FibreId` (int32): the fibre, 0 outside every fibre;
 * - point data `Depth` (float, µm): signed distance bound to the fibre's surface, positive inside, cut off at 4 voxels
 *   outside;
 * - field data `Domain`, `Provenance`; `Growth`, `MinimumGap`, `SurfaceTolerance`, `VoxelSize` (µm, one number each, as used);
 * per fibre `FibreTable.FibreId`, `FibreTable.BundleId`, `FibreTable.TargetRadius`, in the order of the input.
 *
 * The update extent is honoured: only what is asked for is computed and held in memory, and it equals that part of the whole bit
 * for bit. A target fraction is always met over the whole domain. Since the size of the image follows from the input's `Domain`,
 * the input is brought up to date when information is asked for.
 *
 * A fibre thinner than a voxel may hold no voxel's centre: choose VoxelSize at most half the smallest radius.
 */
#ifndef vtkFibreRadialGrowth_h
#define vtkFibreRadialGrowth_h

#include "CactusFiltersModule.h"

#include <vtkImageAlgorithm.h>

#include <memory>

namespace cactus
{
struct Fibres;
}

class CACTUSFILTERS_EXPORT vtkFibreRadialGrowth : public vtkImageAlgorithm
{
public:
  static vtkFibreRadialGrowth* New();
  vtkTypeMacro(vtkFibreRadialGrowth, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Edge of a voxel (µm). Where it does not divide the domain, the nearest spacing that does is used. */
  vtkSetMacro(VoxelSize, double);
  vtkGetMacro(VoxelSize, double);
  ///@}

  ///@{
  /** Fraction of the domain that the grown fibres fill, with their radii on target; 0: grow by GrowthIterations. */
  vtkSetMacro(TargetFibreVolumeFraction, double);
  vtkGetMacro(TargetFibreVolumeFraction, double);
  ///@}

  ///@{
  /** Growth in voxels where no target is given. */
  vtkSetMacro(GrowthIterations, int);
  vtkGetMacro(GrowthIterations, int);
  ///@}

  ///@{
  /** Least distance (µm) between the surfaces of two fibres. */
  vtkSetMacro(MinimumGap, double);
  vtkGetMacro(MinimumGap, double);
  ///@}

  ///@{
  /** Room (µm) left on either side of the gap for smoothing and decimating the surfaces later. */
  vtkSetMacro(SurfaceTolerance, double);
  vtkGetMacro(SurfaceTolerance, double);
  ///@}

  ///@{
  /**
   * How far, as a fraction of its radius, a fibre may fall short of its capsules, at random and smoothly along it, before it
   * grows (0 to 0.5).
   */
  vtkSetMacro(SurfaceRoughness, double);
  vtkGetMacro(SurfaceRoughness, double);
  ///@}

  ///@{
  /** Width (µm) by which the image extends beyond the domain on every side, rounded up to whole voxels. */
  vtkSetMacro(Margin, double);
  vtkGetMacro(Margin, double);
  ///@}

  ///@{
  /** Seed of the random calibre, see SurfaceRoughness. */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /** Threads to use; 0 means all. The result does not depend on it. */
  vtkSetMacro(NumberOfThreads, int);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /** Counts as changed after it was stopped, so that it is asked again and says so. */
  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time) override;

protected:
  vtkFibreRadialGrowth();
  ~vtkFibreRadialGrowth() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkFibreRadialGrowth(const vtkFibreRadialGrowth&) = delete;
  void operator=(const vtkFibreRadialGrowth&) = delete;

  double VoxelSize = 0.1;
  double TargetFibreVolumeFraction = 0.0;
  int GrowthIterations = 4;
  double MinimumGap = 0.02;
  double SurfaceTolerance = 0.0075;
  double SurfaceRoughness = 0.1;
  double Margin = 0.0;
  int Seed = 1;
  int NumberOfThreads = 0;

  // What the target needs, kept from one extent to the next: the fibres that grow, and how far.
  std::unique_ptr<cactus::Fibres> Aimed;
  double Growth = 0.0;
  vtkMTimeType GrowthParameterTime = 0;
  vtkMTimeType GrowthInputTime = 0;
};

#endif
