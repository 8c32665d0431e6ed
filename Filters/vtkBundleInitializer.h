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
#include "OptionProperties.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkBundleInitializer : public vtkPolyDataAlgorithm
{
public:
  static vtkBundleInitializer* New();
  vtkTypeMacro(vtkBundleInitializer, vtkPolyDataAlgorithm);
  CACTUS_PRINTS_PROPERTIES

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
  CACTUS_RADIUS_DISTRIBUTION_PROPERTIES
  CACTUS_CALIBRE_VARIATION_PROPERTIES
  CACTUS_NUMBER_PROPERTY(SectionAxisRatio)
  CACTUS_NUMBER_PROPERTY(GRatio)
  CACTUS_UNMYELINATED_AXONS_PROPERTIES
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
  CACTUS_CONTROL_POINT_SPACING_PROPERTIES
  CACTUS_WHOLE_PROPERTY(Seed)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED
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
