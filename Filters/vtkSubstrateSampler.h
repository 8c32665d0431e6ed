// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubstrateSampler
 * @brief Samples a substrate on a grid of voxels of any size: label maps, exact volume fractions, directions.
 *
 * Input 0 `Outer`, input 1 `Inner` (optional): closed, outward triangle surfaces with cell data `FibreId` and `BundleId`. Input 2
 * `Fibres` (optional): their centre lines. If Outer comes directly from MyelinSurface, Lesion or SubstrateReader, unconnected
 * inputs are taken from that filter.
 *
 * Output: an image whose points are the middles of voxels, from the domain's lower corner on, as many as cover it. Point data:
 * `AVF`, `MVF`, `ExtraAxonalFraction` and `BundleFraction_N` for each bundle (volumes of the meshes over that of the voxel's part
 * in the domain, in single precision); `Compartment` (0 extra-axonal, 1 axon, 2 myelin: the one with the largest fraction);
 * `FibreId` (with the largest volume; 0 where Compartment is 0); `FibreCount`; and with centre lines `MeanDirection` (unit
 * vector, z not negative) and `Dispersion` (degrees; the angle whose squared cosine is the mean of the squared cosines to it; NaN
 * without a fibre). Optional: `FOD` (the fibre orientation distribution as coefficients of spherical harmonics, in MRtrix's basis
 * and order; its integral is the fibre volume fraction) and `Peaks` (nine numbers: the axes of the three bundles that fill most
 * of the voxel, as long as their fractions; NaN for missing ones).
 */
#ifndef vtkSubstrateSampler_h
#define vtkSubstrateSampler_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkImageAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkSubstrateSampler : public vtkImageAlgorithm
{
public:
  static vtkSubstrateSampler* New();
  vtkTypeMacro(vtkSubstrateSampler, vtkImageAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_NUMBER_PROPERTY(VoxelSize)
  CACTUS_WHOLE_PROPERTY(HarmonicsOrder)
  CACTUS_SWITCH_PROPERTY(Peaks)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED

protected:
  vtkSubstrateSampler();
  ~vtkSubstrateSampler() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSubstrateSampler(const vtkSubstrateSampler&) = delete;
  void operator=(const vtkSubstrateSampler&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
