// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCurvedBundles
 * @brief Lays fibres in a bundle that bends or fans out, or in two that kiss, as the start of a substrate.
 *
 * Output: fibres as those of vtkBundleInitializer, in a box around the origin. The method and its guarantees are
 * documented in cactus::layCurvedBundles.
 */
#ifndef vtkCurvedBundles_h
#define vtkCurvedBundles_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkCurvedBundles : public vtkPolyDataAlgorithm
{
public:
  static vtkCurvedBundles* New();
  vtkTypeMacro(vtkCurvedBundles, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  CACTUS_WHOLE_PROPERTY(Shape)
  CACTUS_NUMBER_PROPERTY(BendRadius)
  CACTUS_NUMBER_PROPERTY(FanAngle)
  CACTUS_NUMBER_PROPERTY(KissDistance)
  CACTUS_NUMBER_PROPERTY(Side)
  CACTUS_NUMBER_PROPERTY(Length)
  CACTUS_NUMBER_PROPERTY(FibreVolumeFraction)
  CACTUS_NUMBER_PROPERTY(GrownFibreVolumeFraction)
  CACTUS_NUMBER_PROPERTY(Margin)
  CACTUS_WHOLE_PROPERTY(RadiusDistribution)
  CACTUS_NUMBER_PROPERTY(GammaShape)
  CACTUS_NUMBER_PROPERTY(GammaScale)
  CACTUS_NUMBER_PROPERTY(LognormalMean)
  CACTUS_NUMBER_PROPERTY(LognormalDeviation)
  CACTUS_TEXT_PROPERTY(RadiusTable)
  CACTUS_FILE_PROPERTY(RadiusTableFile)
  CACTUS_TEXT_PROPERTY(RadiusTableColumn)
  CACTUS_NUMBER_PROPERTY(RadiusTableFactor)
  CACTUS_WHOLE_PROPERTY(RadiusHistogram)
  CACTUS_NUMBER_PROPERTY(RadiusHistogramFactor)
  CACTUS_NUMBER_PROPERTY(RadiusHistogramGRatio)
  CACTUS_NUMBER_PROPERTY(MinimumRadius)
  CACTUS_NUMBER_PROPERTY(MaximumRadius)
  CACTUS_WHOLE_PROPERTY(CalibreModel)
  CACTUS_NUMBER_PROPERTY(CalibreVariation)
  CACTUS_NUMBER_PROPERTY(CalibreCorrelationLength)
  CACTUS_NUMBER_PROPERTY(BeadAmplitude)
  CACTUS_NUMBER_PROPERTY(BeadSpacing)
  CACTUS_NUMBER_PROPERTY(BeadSpacingDeviation)
  CACTUS_NUMBER_PROPERTY(BeadLength)
  CACTUS_NUMBER_PROPERTY(SectionAxisRatio)
  CACTUS_NUMBER_PROPERTY(GRatio)
  CACTUS_NUMBER_PROPERTY(SpacingFactor)
  CACTUS_NUMBER_PROPERTY(MinimumSpacing)
  CACTUS_NUMBER_PROPERTY(MaximumSpacing)
  CACTUS_WHOLE_PROPERTY(Seed)

  /** Counts as changed after it was stopped, so that a new request repeats the work; not on several ranks. */
  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time) override;

  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkCurvedBundles();
  ~vtkCurvedBundles() override = default;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCurvedBundles(const vtkCurvedBundles&) = delete;
  void operator=(const vtkCurvedBundles&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
