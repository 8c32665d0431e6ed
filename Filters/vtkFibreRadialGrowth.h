// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFibreRadialGrowth
 * @brief Grows fibres outwards from seeds in their capsules until they meet, as a label image with sub-voxel depth.
 *
 * All fibres grow at the same speed (but for axons without myelin, see cactus::RankedGrowth) until they have grown by
 * `GrowthIterations` voxels, or fill `TargetFibreVolumeFraction` of the domain, or meet a neighbour, from which they keep
 * `MinimumGap` (paper, section "Fibre radial growth"; this computes the limit of that method for small voxels, see
 * core/growth/FibreRadialGrowth.h). No voxel belongs to two fibres, even if capsules overlap. For a target fraction the capsules'
 * radii are changed first, so that each fibre ends at its TargetRadius if these add up to the fraction
 * (core/growth/GrowthTarget.h).
 *
 * Input: fibres (polylines with point data `Radius`). Output: an image of cubic voxels that fill the field data `Domain`, its
 * points the voxels' centres, with
 * - point data `FibreId` (int32): the fibre, 0 outside every fibre;
 * - point data `Depth` (float, µm): signed distance bound to the fibre's surface, positive inside, cut off at 4 voxels
 *   outside;
 * - field data `Domain`, `Provenance`; `Growth`, `MinimumGap`, `SurfaceTolerance`, `VoxelSize` (µm, one number each, as used);
 * per fibre `FibreTable.FibreId`, `FibreTable.BundleId`, `FibreTable.TargetRadius` and `FibreTable.LengthInDomain` (µm, of the
 * centre line inside the domain), in the order of the input.
 *
 * The update extent is respected: only the requested part is computed and held in memory, and it equals that part of the whole
 * bit for bit. A target fraction is always met over the whole domain. The size of the image follows from the input's `Domain`, so
 * the input is updated when information is requested.
 *
 * A fibre thinner than a voxel may contain no voxel centre: choose VoxelSize at most half the smallest radius.
 */
#ifndef vtkFibreRadialGrowth_h
#define vtkFibreRadialGrowth_h

#include "CactusFiltersModule.h"
#include "OptionProperties.h"

#include <vtkDataObject.h>
#include <vtkImageAlgorithm.h>
#include <vtkSmartPointer.h>

#include <memory>

namespace cactus
{
struct Context;
struct FibreRadialGrowthOptions;
struct Fibres;
struct SolvedGrowth;
} // namespace cactus

class CACTUSFILTERS_EXPORT vtkFibreRadialGrowth : public vtkImageAlgorithm
{
public:
  static vtkFibreRadialGrowth* New();
  vtkTypeMacro(vtkFibreRadialGrowth, vtkImageAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_FIBRE_RADIAL_GROWTH_PROPERTIES
  CACTUS_WHOLE_PROPERTY(Seed)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  /** Returns the fibres from which the image was made, which may differ from the present input; null before. */
  vtkDataObject* GrownFibres() const { return this->Fibres; }

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED

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

  std::unique_ptr<cactus::FilterProperties> Properties;
  vtkSmartPointer<vtkDataObject> Fibres; ///< shares the input's arrays

  /// Finds how far which fibres grow, where neither they nor a property are as they were the last time.
  void solve(vtkDataObject* input, const cactus::Fibres& fibres, const cactus::FibreRadialGrowthOptions& options,
    const cactus::Context& context);

  // Results for the target, kept from one extent to the next: the fibres that grow, and how far.
  std::unique_ptr<cactus::Fibres> Aimed;
  std::unique_ptr<cactus::SolvedGrowth> Growth;
  vtkMTimeType GrowthParameterTime = 0;
  vtkMTimeType GrowthInputTime = 0;
};

#endif
