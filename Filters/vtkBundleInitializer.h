// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkBundleInitializer
 * @brief Makes one bundle of fibres, or two crossing ones, with chosen radii, density and dispersion.
 *
 * Output: one polyline per fibre with point data `Radius` (µm), cell data `FibreId`, `BundleId`, `TargetRadius` and field data
 * `Domain` and `Provenance`. The fibres' circles do not overlap on the plane where they were packed; elsewhere fibres may
 * overlap, and vtkCapsuleOptimizer parts them. The method and its guarantees are documented in cactus::initialiseBundles. A
 * density or dispersion that cannot be reached gives one error with the value that was reached, and no output.
 *
 * Method: CACTUS, initialisation.
 */
#ifndef vtkBundleInitializer_h
#define vtkBundleInitializer_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkBundleInitializer : public vtkPolyDataAlgorithm
{
public:
  static vtkBundleInitializer* New();
  vtkTypeMacro(vtkBundleInitializer, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum RadiusDistributions
  {
    GAMMA = 0,
    LOGNORMAL = 1,
    TABLE = 2
  };
  enum Borders
  {
    CUT = 0,
    WALLS = 1
  };
  enum DispersionModels
  {
    WATSON = 0,
    CONE = 1,
    COHERENT = 2,
    HARMONICS = 3,
    PEAKS = 4
  };
  enum Mixings
  {
    INTERPENETRATING = 0,
    LAYERS = 1
  };
  enum CrossingStyles
  {
    INTERWOVEN = 0,
    SHEETS = 1
  };

  CACTUS_NUMBER_PROPERTY(Side)
  CACTUS_NUMBER_PROPERTY(Length)
  CACTUS_NUMBER_PROPERTY(FibreVolumeFraction)
  CACTUS_NUMBER_PROPERTY(GrownFibreVolumeFraction)
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
  CACTUS_NUMBER_PROPERTY(UnmyelinatedFraction)
  CACTUS_NUMBER_PROPERTY(UnmyelinatedRadius)
  CACTUS_NUMBER_PROPERTY(UnmyelinatedRadiusDeviation)
  CACTUS_WHOLE_PROPERTY(UnmyelinatedCluster)
  CACTUS_WHOLE_PROPERTY(Border)
  CACTUS_NUMBER_PROPERTY(MeanDispersion)
  CACTUS_NUMBER_PROPERTY(WatsonKappa)
  CACTUS_NUMBER_PROPERTY(ODI)
  CACTUS_WHOLE_PROPERTY(DispersionModel)
  CACTUS_TEXT_PROPERTY(OrientationHarmonics)
  CACTUS_TEXT_PROPERTY(OrientationPeaks)
  CACTUS_FILE_PROPERTY(OrientationFile)
  CACTUS_VECTOR_PROPERTY(OrientationVoxel)
  CACTUS_NUMBER_PROPERTY(CorrelationLength)
  CACTUS_NUMBER_PROPERTY(Sinuosity)
  CACTUS_NUMBER_PROPERTY(UndulationWavelength)
  CACTUS_WHOLE_PROPERTY(NumberOfBundles)
  CACTUS_VECTOR_PROPERTY(Direction)
  CACTUS_NUMBER_PROPERTY(CrossingAngle)
  CACTUS_WHOLE_PROPERTY(Mixing)
  CACTUS_WHOLE_PROPERTY(CrossingStyle)
  CACTUS_NUMBER_PROPERTY(SheetThickness)
  CACTUS_NUMBER_PROPERTY(Margin)
  CACTUS_NUMBER_PROPERTY(SpacingFactor)
  CACTUS_NUMBER_PROPERTY(MinimumSpacing)
  CACTUS_NUMBER_PROPERTY(MaximumSpacing)
  CACTUS_WHOLE_PROPERTY(Seed)

  /** Counts as changed after it was stopped, so that a new request repeats the warning; not on several ranks. */
  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time) override;

  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkBundleInitializer();
  ~vtkBundleInitializer() override = default;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkBundleInitializer(const vtkBundleInitializer&) = delete;
  void operator=(const vtkBundleInitializer&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
