// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubstrateProduction
 * @brief Grows fibres, makes their surfaces and writes them as a substrate folder, without holding label image and surfaces.
 *
 * Input: fibres, as for vtkFibreRadialGrowth. When the filter executes for the first time after one of its own properties or
 * connections has changed, and by Write(), not because its input has changed, it writes what vtkFibreRadialGrowth,
 * vtkMyelinSurface and vtkSubstrateWriter would with the same properties (Seed is that of both), with the same bits. Output 0
 * `Files`: the table of the files. Output 1 `Fibre statistics`: that of vtkMyelinSurface.
 *
 * What is made goes to the folder `FolderName.work`. A run that was stopped or killed goes on from there when the filter executes
 * again, with the same fibres, properties and version; at its end that folder is gone. Progress tells the pace. The method is
 * core/io/SubstrateProduction.h. On several ranks all of them share the work; the first one has the
 * tables, and reports.
 */
#ifndef vtkSubstrateProduction_h
#define vtkSubstrateProduction_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"
#include "KeptFolder.h"

#include <vtkNew.h>
#include <vtkTable.h>
#include <vtkTableAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkSubstrateProduction : public vtkTableAlgorithm
{
public:
  static vtkSubstrateProduction* New();
  vtkTypeMacro(vtkSubstrateProduction, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  CACTUS_NUMBER_PROPERTY(VoxelSize)
  CACTUS_NUMBER_PROPERTY(TargetFibreVolumeFraction)
  CACTUS_WHOLE_PROPERTY(GrowthIterations)
  CACTUS_NUMBER_PROPERTY(MinimumGap)
  CACTUS_NUMBER_PROPERTY(SurfaceTolerance)
  CACTUS_NUMBER_PROPERTY(SurfaceRoughness)
  CACTUS_NUMBER_PROPERTY(Margin)
  CACTUS_WHOLE_PROPERTY(GRatioModel)
  CACTUS_NUMBER_PROPERTY(GRatio)
  CACTUS_NUMBER_PROPERTY(GRatioDeviation)
  CACTUS_NUMBER_PROPERTY(TargetAxonVolumeFraction)
  CACTUS_WHOLE_PROPERTY(SmoothingIterations)
  CACTUS_NUMBER_PROPERTY(DecimationError)
  CACTUS_NUMBER_PROPERTY(MinimumAngle)
  CACTUS_SWITCH_PROPERTY(ClipToDomain)
  CACTUS_WHOLE_PROPERTY(Seed)
  CACTUS_FILE_PROPERTY(FolderName)
  CACTUS_WHOLE_PROPERTY(Format)
  CACTUS_WHOLE_PROPERTY(Encoding)
  CACTUS_SWITCH_PROPERTY(AllowOpenSurfaces)
  CACTUS_NUMBER_PROPERTY(SampledFraction)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  /** Writes the folder, whatever has or has not changed. Gives 1, or 0 where it could not be written. */
  int Write();

  /** Counts as changed after it was stopped, so that it is asked again and says so; not on several ranks. */
  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time) override;

  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkSubstrateProduction();
  ~vtkSubstrateProduction() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSubstrateProduction(const vtkSubstrateProduction&) = delete;
  void operator=(const vtkSubstrateProduction&) = delete;

  void Produce();

  std::unique_ptr<cactus::FilterProperties> Properties;
  cactus::KeptFolder Kept;
  vtkNew<vtkTable> Files; ///< what was written last
  vtkNew<vtkTable> Fibres;
};

#endif
